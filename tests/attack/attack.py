#!/usr/bin/env python3
"""Tries the doors of a built program as a stranger would who gives it files, lines and signals: attack.py PROGRAM [DOOR]...

Each door is a function that returns why it stands open, or nothing. Prints those, and exits with their number. It needs no
more than Python; a door whose tool is not installed is left out.
"""

import json
import os
import resource
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time

PROGRAM = os.path.abspath(sys.argv[1])
CYLINDER = {"indenter": "cylinder", "radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 3e6, "stiffening": 1,
            "creep_time": 0.25, "speed": 0.05, "load": 20e3, "friction_coefficient": 0.2, "drive": "top_force"}
# Takes minutes, and is given them.
DEAR = {**CYLINDER, "indenter": "sphere", "load": 150, "tolerance": 1e-9, "time_limit": 600}


def write(name, content):
    with open(name, "w", encoding="utf-8") as file:
        file.write(content if isinstance(content, str) else json.dumps(content))
    return name


def run(*words, environment=None, before=None, seconds=60, stdin=None):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, errors="replace", timeout=seconds, input=stdin,
                          env={**os.environ, **(environment or {})}, preexec_fn=before)


def swept(database="a.db", points=3, name="study"):
    """A database with a small study."""
    speeds = [round(0.01 * (i + 1), 6) for i in range(points)]
    study = write(name + ".json", {"study": name, "scene": {**CYLINDER, "friction_coefficient": 0}, "axes": {"speed": speeds}})
    done = run("sweep", study, "--db", database)
    assert done.returncode == 0, done.stderr
    return database


def execute(database, *statements):
    connection = sqlite3.connect(database)
    for statement in statements:
        connection.execute(statement)
    connection.commit()
    connection.close()


def memory_of(*words):
    """The exit status and the most memory that a run took [bytes]."""
    child = subprocess.Popen([PROGRAM, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, usage.ru_maxrss * 1024


class Server:
    """`rollres serve --socket`, ended with the block."""

    def __init__(self, *words, before=None):
        self.process = subprocess.Popen([PROGRAM, "serve", "--socket", "socket", *words], stderr=subprocess.PIPE, text=True,
                                        preexec_fn=before)
        self.clients = []

    def __enter__(self):
        self.connect()
        return self

    def __exit__(self, *_):
        for client in self.clients:
            client.close()
        self.process.kill()
        self.process.communicate()

    def connect(self):
        client = socket.socket(socket.AF_UNIX)
        client.settimeout(20)
        for _ in range(500):
            try:
                client.connect("socket")
                break
            except (FileNotFoundError, ConnectionRefusedError):
                assert self.process.poll() is None, self.process.stderr.read()
                time.sleep(0.01)
        self.clients.append(client)
        return client

    def processor_seconds(self):
        with open(f"/proc/{self.process.pid}/stat", encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def is_busy(self):
        """Whether it works: what spins takes a whole processor, or a share where others work; what waits takes none."""
        before = self.processor_seconds()
        for _ in range(4):
            time.sleep(0.4)
            if self.processor_seconds() - before > 0.1:
                return True
        return False


def ask(client, *scenes):
    client.sendall(b"".join(json.dumps(scene).encode() + b"\n" for scene in scenes))


def answer(client):
    """The next line, which is all that has come."""
    text = b""
    while not text.endswith(b"\n"):
        part = client.recv(65536)
        if not part:
            return {}
        text += part
    return json.loads(text)


# Databases of strangers


def a_column_of_a_merged_database_is_sql():
    swept("mine.db")
    swept("theirs.db", name="other")
    planted = 'x" TEXT; COMMIT; ATTACH \'planted\' AS w; CREATE TABLE w.t(a); BEGIN; --'
    execute("theirs.db", 'ALTER TABLE evaluation ADD COLUMN "%s" TEXT' % planted.replace('"', '""'))
    os.mkdir("folder")
    shutil.copy("theirs.db", "folder/results.db")
    for words in (["merge", "theirs.db", "--db", "mine.db"], ["import", "folder", "--db", "mine.db"],
                  ["export", "--db", "theirs.db", "--out", "exported"],
                  ["query", "--db", "mine.db", "--db", "theirs.db"], ["list", "--db", "theirs.db"],
                  ["query", "--db", "theirs.db", "--columns", planted, "--format", "csv"],
                  ["merge", "mine.db", "--db", "theirs.db"]):
        done = run(*words)
        if os.path.exists("planted"):
            return f"{words[0]} ran it"
        if words[0] in ("merge", "import") and words[-1] == "mine.db" and not (done.returncode == 2 and "column" in done.stderr):
            return f"{words[0]} does not refuse it: {done.stderr}"
    return None


def names_of_tables_are_sql():
    swept("mine.db")
    swept("theirs.db", name="other")
    name = 't"; ATTACH \'planted\' AS w; CREATE TABLE w.t(a); --'.replace('"', '""')
    for database in ("mine.db", "theirs.db"):
        execute(database, f'CREATE TABLE "{name}"(id INTEGER PRIMARY KEY, "a b""c" TEXT UNIQUE)')
    execute("theirs.db", f'INSERT INTO "{name}" VALUES (7, \'text\')')
    done = run("merge", "theirs.db", "--db", "mine.db")
    if os.path.exists("planted") or done.returncode != 0:
        return done.stderr or "it ran"
    copied = sqlite3.connect("mine.db").execute(f'SELECT "a b""c" FROM "{name}"').fetchall()
    return None if copied == [("text",)] else f"lost: {copied}"


def a_trigger_changes_answers():
    swept("a.db")
    execute("a.db", "CREATE TRIGGER t AFTER INSERT ON evaluation BEGIN UPDATE evaluation SET rolling_resistance = 7; END")
    swept("a.db", points=4, name="later")
    rows = sqlite3.connect("a.db").execute("SELECT count(*) FROM evaluation WHERE rolling_resistance = 7").fetchone()
    return None if rows == (0,) else f"{rows[0]} answers changed"


def a_small_blob_takes_all_memory():
    import zlib
    swept("a.db", points=1)
    header = bytes(32) + (0).to_bytes(4, "little") * 2 + (20000).to_bytes(4, "little") * 2 + (0).to_bytes(4, "little")
    press = zlib.compressobj(6)
    packed = press.compress(header) + b"".join(press.compress(bytes(1 << 20)) for _ in range(100)) + press.flush()
    connection = sqlite3.connect("a.db")
    connection.execute("INSERT INTO fields SELECT key, 1, ? FROM evaluation", (packed,))
    connection.commit()
    connection.close()
    status, most = memory_of("show", "1", "--db", "a.db", "--fields", "folder")
    return None if status == 3 and most < 100e6 else f"{len(packed)} bytes took {most / 1e6:.0f} MB, status {status}"


def an_answer_under_a_limit_is_recalled():
    dear = {**CYLINDER, "tolerance": 1e-4}
    for limit in ({"time_limit": 1e-6}, {"memory_limit": 1e3}):
        lines = "".join(json.dumps(scene) + "\n" for scene in ({**dear, **limit}, dear))
        answers = [json.loads(line) for line in run("serve", "--db", "a.db", "--jobs", "1", stdin=lines).stdout.splitlines()]
        if [one["status"] for one in answers] != ["not_converged", "converged"]:
            return f"{limit}: {[one.get('status', one) for one in answers]}"
    return None


# Files


def a_pipe_is_replaced_by_a_file():
    swept("a.db")
    os.mkdir("folder")
    pipe = "folder/README.txt"
    os.mkfifo(pipe)
    heard = []
    listener = threading.Thread(target=lambda: heard.append(open(pipe, encoding="utf-8").read()), daemon=True)
    listener.start()
    done = run("export", "--db", "a.db", "--out", "folder")
    listener.join(5)
    if os.path.isfile(pipe):
        return "replaced"
    return None if heard and heard[0] and done.returncode == 0 else f"not written to: {done.stderr}"


def a_link_laid_in_wait_is_written_through():
    swept("a.db")
    write("victim", "kept")
    os.mkdir("folder")
    code = ("import os, sys; os.symlink('../victim', f'folder/README.txt.{os.getpid()}.part'); "
            "os.execv(sys.argv[1], sys.argv[1:])")
    subprocess.run([sys.executable, "-c", code, PROGRAM, "export", "--db", "a.db", "--out", "folder"],
                   capture_output=True, timeout=60, check=False)
    return None if open("victim", encoding="utf-8").read() == "kept" else "the file behind it is lost"


def a_cell_is_a_formula():
    swept("a.db", name="=1+2")
    text = run("query", "--db", "a.db", "--columns", "study,speed", "--format", "csv").stdout
    return None if "\"'=1+2\"" in text and "0.01" in text.replace('"', "") else text


def a_file_that_may_not_grow_ends_in_silence():
    swept("a.db")
    done = run("export", "--db", "a.db", "--out", "folder",
               before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
    return None if done.returncode == 3 and done.stderr else f"status {done.returncode}: {done.stderr}"


def no_place_for_temporary_files_is_not_told():
    for database in ("a.db", "b.db"):
        swept(database)
    if run("query", "--db", "a.db", "--db", "b.db", environment={"TMPDIR": ""}).returncode != 0:
        return "an empty TMPDIR"
    done = run("query", "--db", "a.db", "--db", "b.db", environment={"TMPDIR": "/nowhere"})
    return None if done.returncode == 3 and "TMPDIR = /nowhere" in done.stderr else done.stderr


def a_chart_obeys_the_environment():
    if not shutil.which("gnuplot"):
        return None
    swept("a.db")
    done = run("chart", "--db", "a.db", "--out", "chart",
               environment={"GNUTERM": "nonsense"})
    return None if done.returncode == 0 else done.stderr


def a_pipe_beside_the_database_holds_a_sweep():
    os.mkfifo("a.db.ended")
    try:
        swept("a.db")
    except subprocess.TimeoutExpired:
        return "it hangs"
    except AssertionError as error:
        return None if "a.db.ended" in str(error) else str(error)
    return None


def a_small_stack_crashes():
    scene = write("scene.json", {**CYLINDER, "interior": "on"})
    stack = 128 * 1024
    done = run("solve", scene, before=lambda: resource.setrlimit(resource.RLIMIT_STACK, (stack, stack)))
    return f"signal {-done.returncode}" if done.returncode < 0 else None


def sigterm_leaves_folders_behind():
    for database in ("a.db", "b.db"):
        swept(database, points=40)
    os.mkdir("temporary")
    for wait in (0.02, 0.05, 0.1, 0.2, 0.4):
        process = subprocess.Popen([PROGRAM, "report", "--db", "a.db", "--out", "report.html"], stderr=subprocess.DEVNULL,
                                   env={**os.environ, "TMPDIR": os.path.abspath("temporary")})
        time.sleep(wait)
        process.terminate()
        process.wait()
        if os.listdir("temporary"):
            return f"after {wait} s: {os.listdir('temporary')}"
    return None


# Studies that others change


def a_study_that_is_taken_away_is_swept():
    speeds = {"from": 0.001, "to": 1, "points": 20_000}
    study = write("study.json", {"study": "mine", "scene": {**CYLINDER, "tolerance": 1e-5}, "axes": {"speed": speeds}})
    for change, words in ((["delete", "mine"], "deleted"), (["rename", "mine", "theirs"], "renamed to theirs")):
        database = change[0] + ".db"
        process = subprocess.Popen([PROGRAM, "sweep", study, "--db", database], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        time.sleep(0.2)
        for _ in range(100):
            if run(*change, "--db", database).returncode == 0:
                break
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)  # what is in work is stored, the rest left out
        out, err = process.communicate(timeout=60)
        if process.returncode != 3 or words not in err:
            return f"{change[0]}: status {process.returncode}: {out}{err}"
    return None


# A server


def a_line_reads_any_file():
    write("secret.csv", "the secret\n")
    os.mkdir("folder")
    os.mkfifo("folder/pipe.csv")
    os.symlink("../secret.csv", "folder/link.csv")
    material = {key: CYLINDER[key] for key in CYLINDER if key not in ("static_shear_modulus", "stiffening", "creep_time")}
    names = [os.path.abspath("secret.csv"), "../secret.csv", "link.csv", "pipe.csv", "/dev/stdin", "/dev/zero", "secret.csv"]
    scenes = [{**material, "material": "master_curve", "master_curve_file": name} for name in names]
    lines = "".join(json.dumps(scene) + "\n" for scene in scenes)
    for words in ([], ["--files", "folder"]):
        try:
            done = run("serve", "--jobs", "1", *words, stdin=lines, seconds=10)
        except subprocess.TimeoutExpired:
            return f"it hangs {words}"
        if "the secret" in done.stdout:
            return f"it tells the secret {words}"
        if words and sum("folder of --files" in line for line in done.stdout.splitlines()) != len(names):
            return done.stdout + done.stderr
    return None


def a_dear_client_holds_up_others():
    with Server("--jobs", "1") as server:
        ask(server.clients[0], *[{**DEAR, "speed": 0.05 + i} for i in range(20)])
        time.sleep(0.3)
        client = server.connect()
        begin = time.monotonic()
        ask(client, CYLINDER)
        try:
            status = answer(client).get("status")
        except socket.timeout:
            return "no answer within 20 s"
        return None if status == "converged" else f"{status} after {time.monotonic() - begin:.1f} s"


def lines_outlive_their_client():
    with Server("--jobs", "1") as server:
        ask(server.clients[0], *[{**DEAR, "speed": 0.05 + i} for i in range(20)])
        time.sleep(0.3)
        server.clients[0].close()
        time.sleep(0.5)
        return "they are solved after it has gone" if all(server.is_busy() for _ in range(4)) else None


def a_server_goes_on_after_sigterm():
    with Server("--jobs", "1") as server:
        ask(server.clients[0], DEAR)
        time.sleep(0.3)
        server.process.terminate()
        others = resource.getrusage(resource.RUSAGE_CHILDREN)
        before = others.ru_utime + others.ru_stime + server.processor_seconds()
        try:
            server.process.wait(30)
        except subprocess.TimeoutExpired:
            return "not ended within 30 s"
        # Of its own: on a loaded machine the clock tells of the others.
        ended = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = ended.ru_utime + ended.ru_stime - before
        if seconds > 2:
            return f"computed for {seconds:.1f} s more"
        return "the socket's file is left" if os.path.exists("socket") else None


def a_dead_socket_keeps_a_server_out():
    with Server() as server:
        server.process.kill()
        server.process.wait()
    if not os.path.exists("socket"):
        return None
    with Server() as server:
        ask(server.clients[-1], CYLINDER)
        first = answer(server.clients[-1]).get("status")
        second = run("serve", "--socket", "socket", seconds=10)
        if second.returncode != 3:
            return "a second server took the socket of a living one"
        return None if first == "converged" else "no answer"


def no_descriptors_are_left():
    with Server("--jobs", "1", before=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (20, 20))) as server:
        for _ in range(40):
            server.connect()
        if server.is_busy():
            return "it spins"
        if server.process.poll() is not None:
            return "the server ended: " + server.process.stderr.read()
        ask(server.clients[0], CYLINDER)
        return None if answer(server.clients[0]).get("status") == "converged" else "no answer"


def no_threads_are_left():
    if os.getuid() == 0:
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (600 << 20, 600 << 20))  # stacks of 8 MB
    else:
        limit = lambda: resource.setrlimit(resource.RLIMIT_NPROC, (8, 8))
    with Server("--jobs", "1", before=limit) as server:
        for _ in range(60):
            server.connect()
        time.sleep(0.5)
        if server.process.poll() is not None:
            return "the server ended: " + server.process.stderr.read()
        # Which clients have lost their threads is chance. When they are gone, the next one has its answer.
        for client in server.clients:
            client.close()
        for _ in range(50):
            try:
                ask(server.connect(), CYLINDER)
                if answer(server.clients[-1]).get("status") == "converged":
                    return None
            except OSError:
                pass
            time.sleep(0.1)
        return "no answer"


def many_clients_take_all_memory():
    with Server("--jobs", "1") as server:
        line = b'{"id": "' + b"x" * 900_000 + b'"}\n'  # which comes back, and is not read

        def flood():
            client = server.connect()
            try:
                for _ in range(40):
                    client.sendall(line)
            except OSError:
                pass

        for _ in range(12):
            threading.Thread(target=flood, daemon=True).start()
        most, before = 0, -1
        while most > before:
            before = most
            time.sleep(0.5)
            with open(f"/proc/{server.process.pid}/status", encoding="ascii") as file:
                most = next(int(one.split()[1]) for one in file if one.startswith("VmHWM")) / 1000
        return None if most < 250 else f"{most:.0f} MB"


def a_nested_line_ends_the_server():
    deep = '{"id": ' + "[" * 400_000 + "]" * 400_000 + "}\n"
    done = run("serve", "--jobs", "1", stdin=deep + json.dumps(CYLINDER) + "\n")
    return None if done.returncode == 0 and "converged" in done.stdout else f"status {done.returncode}"


DOORS = [door for name, door in list(globals().items())
         if callable(door) and getattr(door, "__module__", "") == "__main__" and "_" in name and not door.__doc__]


def main():
    wanted = sys.argv[2:]
    stands_open = 0
    for door in DOORS:
        if wanted and door.__name__ not in wanted:
            continue
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                why = door()
            except Exception as error:  # a door that cannot be tried is none that is shut
                why = f"{type(error).__name__}: {error}"
            os.chdir("/")
        name = door.__name__.replace("_", " ")
        print(f"{'OPEN' if why else 'shut'}  {name} ({time.monotonic() - begin:.1f} s)" + (f": {why.strip()[:400]}" if why else ""))
        stands_open += bool(why)
    return stands_open


if __name__ == "__main__":
    sys.exit(main())
