"""The Python package as a user meets it: package.py PART. Each part prints nothing unless it fails."""

import ast
import gc
import json
import os
import pathlib
import pickle
import resource
import signal
import sys
import tempfile
import threading
import time

import rollres

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "studies" / "examples"
CYLINDER = EXAMPLES / "paper_cylinder.json"
SPHERE = dict(indenter="sphere", radius="2 cm", layer_thickness="5 mm", static_shear_modulus="3 MPa", stiffening=1,
              creep_time="0.25 s", speed="5 cm/s", load="40 N", friction_coefficient=0.2)


def refusal(act, kind=ValueError):
    try:
        act()
    except kind as error:
        return str(error)
    raise AssertionError("nothing was refused")


def values():
    """Inputs as in scene files, answers in SI under the keys of the lists."""
    one = rollres.solve(CYLINDER, tolerance=1e-6)
    scene = rollres.Scene(CYLINDER).replace(tolerance=1e-6)
    assert scene == rollres.Scene(str(CYLINDER), tolerance=1e-6) == rollres.Scene(scene.to_dict())
    assert scene == pickle.loads(pickle.dumps(scene))
    assert scene != scene.replace(speed="1 m/s") and len({scene, scene.replace(speed="5 cm/s")}) == 1
    assert scene.spacing is None and scene.tolerance == 1e-6 and scene.indenter == "cylinder" and scene.radius == 0.02
    assert rollres.solve(scene).rolling_resistance == one.rolling_resistance
    assert rollres.solve(scene.to_dict()).rolling_resistance == one.rolling_resistance
    assert one.status == "converged" and one.reason == "" and one.scene == scene and isinstance(one.warnings, list)
    assert set(one.to_dict()) == {key for key, *_ in rollres.quantities("outputs")}
    assert abs(one.load - 20e3) < 1e-6 * 20e3 and one.half_width != one.half_width and isinstance(one.iterations, int)
    assert f"{one.rolling_resistance:.6g}" in repr(one) and "converged" in one._repr_html_() and "[N/m" in one._repr_html_()
    assert str(one).startswith("status   converged") and json.loads(one.json())["scene"]["radius"] == 0.02
    coated = rollres.Scene(CYLINDER, tolerance=1e-4, coating_layers=[{"layer_thickness": "2 mm", "material": "elastic",
                                                                     "static_shear_modulus": 5e6}])
    thicker = coated.replaced({"coating_layers[0].layer_thickness": "3 mm"})
    assert thicker.coating_layers[0]["layer_thickness"] == 0.003 and "coating_layers" in repr(thicker)
    assert coated.replace(layer_thickness=float("inf")).to_dict()["layer_thickness"] == "infinite"
    assert scene.replace(approach="0.1 mm").load is None and scene.replace(tolerance=None).tolerance is None
    assert rollres.Scene(CYLINDER, spacing=None) == rollres.Scene(CYLINDER).replace(spacing=None)
    import numpy as np
    assert rollres.Scene(scene, speed=np.float64(0.1), load=np.int64(10000)).load == 10000
    slow = rollres.solve(CYLINDER, drive="torque", driving_torque=200)
    assert slow.status == "no_steady_state" and slow.reason in repr(slow)


def refusals():
    """The words of the command line."""
    assert refusal(lambda: rollres.solve(CYLINDER, speed=-1)) == "--set: speed = -1: must be > 0"
    assert refusal(lambda: rollres.solve(speeed=1)) == "scene: speeed = 1: unknown key; did you mean speed?"
    assert refusal(lambda: rollres.Scene({"radius": "5 kg"})) == 'scene: radius = "5 kg": must have a unit of length (m)'
    assert refusal(lambda: rollres.solve()) == "scene: radius is missing: every scene needs it (m)"
    assert refusal(lambda: rollres.solve(CYLINDER, load=1, approach=1e-3)).endswith("give load or approach, not both")
    cylinder = rollres.Scene(CYLINDER)
    assert refusal(lambda: cylinder.replace(load=1, approach=1e-3)).endswith("give load or approach, not both")
    assert refusal(lambda: rollres.Scene(CYLINDER).replace(speed=None)).startswith("--set: speed = null: must be a number")
    assert "unknown key" in refusal(lambda: rollres.Scene(CYLINDER).replace(speeed=None))
    wide = cylinder.replace(width=0.1, load=2e3)
    assert wide.load == 2e3 and wide.replace(width=None, load=20e3) == cylinder
    assert refusal(lambda: wide.replace(width=None)) == (
        "--set: width = null: load = 2000 was given of the whole body: give it too, per metre")
    assert "load = 20000 was given per metre" in refusal(lambda: cylinder.replace(width=0.1))
    assert "given of the whole body" in refusal(lambda: rollres.Scene(wide.to_dict()).replace(width=None))
    assert refusal(lambda: rollres.objective(CYLINDER, {"layer_thickness": (3e-3, 6)})) == (
        'bounds: layer_thickness = 6: did you mean "6 mm"? A number without a unit is in m: write "6 m" if that is meant')
    assert "6 mm" in refusal(lambda: cylinder.replace(layer_thickness=6)) and "6 mm" in refusal(
        lambda: rollres.Scene(CYLINDER, layer_thickness=6))
    assert "name radius" in refusal(lambda: rollres.objective(CYLINDER, ["diameter"]))
    assert "No such file" in refusal(lambda: rollres.solve("no.json"), OSError)
    assert refusal(lambda: rollres.solve(CYLINDER, radius=[1])) == (
        "--set: radius = [1]: must be a number or a text with a unit of length (m)")
    assert "did you mean speed?" in refusal(lambda: rollres.gradient(CYLINDER, ["sped"]))
    assert "did you mean rolling_resistance?" in refusal(lambda: rollres.objective(CYLINDER, ["load"], "roling_resistance"))
    assert "no.json" in refusal(lambda: rollres.sweep("no.json", "no.db"), OSError)
    assert refusal(lambda: rollres.command("sove")).startswith("sove: unknown command")
    with tempfile.TemporaryDirectory() as folder:
        assert "missing.db" in refusal(lambda: rollres.open(folder + "/missing.db"), OSError)


def hostile():
    """What is no input is refused in words, whatever it is."""
    import numpy as np
    assert refusal(lambda: rollres.solve(CYLINDER, load=float("nan"))).startswith('--set: load = "nan": must be')
    assert refusal(lambda: rollres.solve(CYLINDER, load=-np.inf)).startswith('--set: load = "-infinite": must be')
    assert "load = true: must be" in refusal(lambda: rollres.solve(CYLINDER, load=np.bool_(True)))
    assert rollres.Scene(CYLINDER, load=np.array(1e4)).load == rollres.Scene(CYLINDER, load=np.float32(1e4)).load == 1e4
    assert rollres.Scene(CYLINDER, load=10**20).load == 1e20
    assert "beyond 1e308" in refusal(lambda: rollres.solve(CYLINDER, load=10**400))
    for strange in (object(), {1, 2}, b"1 kN", lambda: 1):
        assert "is no input" in refusal(lambda: rollres.solve(CYLINDER, load=strange), TypeError)
    itself, listed = {}, []
    itself["scene"], deep = itself, []
    listed.append(listed)
    for _ in range(100000):
        deep = [deep]
    for nested in (lambda: rollres.solve(itself), lambda: rollres.solve(CYLINDER, lower_layers=listed),
                   lambda: rollres.solve(CYLINDER, lower_layers=deep), lambda: rollres.sweep(itself, "no.db")):
        refusal(nested)
    while deep:  # Python would call itself for each level
        deep = deep[0]
    assert "NUL" in refusal(lambda: rollres.solve("a\0b"))
    assert "surrogates" in refusal(lambda: rollres.solve(CYLINDER, load="\ud800"))
    refusal(lambda: rollres.sweep({"study": {1}}, "no.db"), TypeError)
    unmade = rollres.Scene.__new__(rollres.Scene)  # whose __init__ was never called
    for use in (lambda: unmade.load, lambda: unmade.json(), lambda: rollres.solve(unmade),
                lambda: rollres.Fields.__new__(rollres.Fields).pressure):
        assert "never made" in refusal(use, TypeError)
    with tempfile.TemporaryDirectory() as folder:
        rollres.solve_many([CYLINDER], db=folder + "/a.db")
        stored = rollres.open(folder + "/a.db")
        assert "\\xff" in str(stored.sql("SELECT CAST(x'ff' AS TEXT) AS a"))
        assert "NUL" in refusal(lambda: stored.sql("SELECT 1\0; DROP"))
        assert len(stored.query(columns="load", sort="load")) == 1
    assert rollres.gradient(CYLINDER, "load").inputs[0].key == "load"
    fitted = {"fit": "f", "scene": str(CYLINDER), "parameters": {"static_shear_modulus": {}}}
    uneven = {"speed [m/s]": [1, 2, 3], "rolling_resistance [N/m]": [1, 2]}
    assert "different lengths" in refusal(lambda: rollres.fit(fitted, data=uneven))
    assert "must have no comma" in refusal(lambda: rollres.fit(fitted, data={"a,b": [1], "speed [m/s]": [1]}))
    failures = []

    def solves():
        try:
            rollres.solve(CYLINDER)
            refusal(lambda: rollres.solve(CYLINDER, speed=-1))
        except BaseException as error:
            failures.append(error)
    threads = [threading.Thread(target=solves) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures, failures


def fields():
    """Arrays that share the answer's memory and keep it."""
    import numpy as np
    one = rollres.solve(CYLINDER)
    found = one.fields
    assert found.pressure.base is not None and not found.pressure.flags.owndata and not found.pressure.flags.writeable
    assert found.pressure.__array_interface__["data"] == one.fields.pressure.__array_interface__["data"]
    assert found.pressure.shape == found.x.shape == found.zone.shape and found.v is None and found.shear_y is None
    # The load is the pressure's sum but for terms of second order in the slope, (a/R)^2.
    assert abs(np.sum(found.pressure) * (found.x[1] - found.x[0]) / one.load - 1) < 0.02
    assert set(np.unique(found.zone)) <= {0, 1, 2} and np.count_nonzero(found.zone) == one.contact_nodes
    sphere = rollres.solve(SPHERE).fields
    assert sphere.pressure.shape == (len(sphere.y), len(sphere.x)) == sphere.shear_y.shape
    pressure = rollres.solve(CYLINDER).fields.pressure
    gc.collect()
    assert pressure.max() == one.peak_pressure
    assert rollres.solve_many([CYLINDER])[0].fields is None
    assert rollres.solve_many([CYLINDER], fields=True)[0].fields is not None


def many():
    """Many scenes: by threads, from tables, through a database, with progress."""
    base = rollres.Scene(CYLINDER, tolerance=1e-6)
    speeds = [0.01 * 1.05**i for i in range(60)]
    told = []
    results = rollres.solve_many([{"speed": speed} for speed in speeds], base, threads=2,
                                 progress=lambda done, all: told.append((done, all)))
    alone = [rollres.solve(base, speed=speed).rolling_resistance for speed in speeds]
    assert [result.rolling_resistance for result in results] == alone
    assert told[-1] == (60, 60) and told == sorted(told)
    failing = rollres.solve_many([base.replace(drive="torque", driving_torque=200), base])
    assert [one.status for one in failing] == ["no_steady_state", "converged"]
    assert rollres.solve_many([]) == []
    with tempfile.TemporaryDirectory() as folder:
        first = rollres.solve_many([{"speed": speed} for speed in speeds], base, db=folder + "/many.db")
        again = rollres.solve_many([{"speed": speed} for speed in speeds], base, db=folder + "/many.db")
        assert [one.rolling_resistance for one in first] == alone == [one.rolling_resistance for one in again]
        assert [one.seconds for one in first] == [one.seconds for one in again]  # recalled
        stored = rollres.open(folder + "/many.db").sql("SELECT count(*) AS rows FROM evaluation")
        assert stored["rows"][0] == 60 if hasattr(stored, "columns") else stored == [{"rows": 60}]

    def broken(done, all):
        raise RuntimeError("no more")
    assert refusal(lambda: rollres.solve_many([SPHERE] * 50, progress=broken), RuntimeError) == "no more"
    try:
        import pandas
    except ImportError:
        print("pandas is not there: not tried")
        return
    frame = pandas.DataFrame({"speed": ["1 m/s", None], "load": [10e3, float("nan")]})
    first, second = rollres.solve_many(frame, base)
    assert (first.scene.speed, first.scene.load, second.scene.speed, second.scene.load) == (1, 10e3, 0.05, 20e3)


def interrupts():
    """Ctrl-C ends one long solution, many and a gradient within a tenth of a second (measured: half of it)."""
    long = rollres.Scene(SPHERE, tolerance=1e-5, time_limit=300)

    def interrupted(act):
        before = threading.Timer(0.3, lambda: (sent.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT)))
        sent = []
        before.start()
        refusal(act, KeyboardInterrupt)
        return time.monotonic() - sent[0]
    waits = [interrupted(act) for act in (
        lambda: rollres.solve(long), lambda: rollres.solve_many([long] * 4, threads=2),
        lambda: rollres.solve_many([rollres.Scene(CYLINDER, tolerance=1e-8)] * 100000, threads=2),
        lambda: rollres.gradient(long, ["load"], threads=2))]
    print("seconds until KeyboardInterrupt:", waits, file=sys.stderr)
    assert rollres.solve(CYLINDER).status == "converged"  # afterwards all is as before
    return waits


def models():
    mat = dict(radius=0.05, layer_thickness=0.01, static_shear_modulus=1e6, stiffening=3, creep_time=5e-3, speed=0.2,
               load=3000, tolerance=1e-2,
               lower_layers=[dict(layer_thickness=0.1, material="elastic", static_shear_modulus=12.5e9)])
    model = rollres.model(mat)
    assert len(model.foundation) == 1 and len(model.decisions) == 1, model
    assert model.method == rollres.solve(mat).method
    assert abs(model.tolerance + model.left_out - 1e-2) < 1e-15
    refusal(lambda: rollres.model(mat, speed=-1))


def functions():
    """Objectives and gradients against each other and closed forms of scaling; models."""
    models()
    f = rollres.objective(CYLINDER, {"load": (1e3, 1e5), "creep_time": None}, tolerance=1e-8)
    assert f.names == ["load", "creep_time"] and f.bounds[0] == (1e3, 1e5)
    thick = rollres.objective(CYLINDER, {"layer_thickness": ("2 mm", 0.01)})
    assert thick.bounds == [(2e-3, 0.01)]
    assert f.x0 == [20e3, 0.25] and f.scales == [20e3, 0.25]
    value, slopes, errors = f.value_and_gradient(f.x0)
    assert value == f(f.x0) == rollres.solve(CYLINDER, tolerance=1e-8).rolling_resistance
    report = rollres.gradient(CYLINDER, ["load", "creep_time"], tolerance=1e-8)
    for slope, error, told in zip(slopes, errors, report["inputs"]):
        assert abs(slope - told["derivative"]) <= 1e-6 * abs(slope) and abs(error) < 1e-4 * abs(slope)
    scaled = f.scaled.gradient(f.scaled.x0)
    assert all(abs(s - g * x) < 1e-6 * abs(s) for s, g, x in zip(scaled, slopes, f.x0))
    assert all(abs(there / x - 1) < 1e-14 for there, x in zip(f.scaled.values(f.scaled.x0), f.x0))
    assert "must be" in refusal(lambda: f([1.0, 0.25]))
    assert f.solve_many([f.x0])[0].rolling_resistance == value and f.scene([2e3, 1]).load == 2e3
    # Twice as quick with half the time of creep is the same layer.
    quick = rollres.objective(rollres.Scene(CYLINDER, tolerance=1e-8, speed=0.1), ["creep_time"])
    assert abs(quick([0.125]) / value - 1) < 1e-9


def studies():
    """Sweeps, fits and databases."""
    with tempfile.TemporaryDirectory() as folder:
        told = []
        study = {"study": "speeds", "scene": CYLINDER, "set": {"tolerance": 1e-6},
                 "axes": {"speed": {"from": "1 mm/s", "to": "1 m/s", "points": 7, "spacing": "logarithmic"}}}
        report = rollres.sweep(study, folder + "/a.db", progress=lambda done, all: told.append((done, all)))
        assert (report.points, report.solved, report.failed) == (7, 7, 0) and told[-1] == (7, 7)
        assert rollres.sweep(study, folder + "/a.db").recalled == 7
        results = rollres.open(folder + "/a.db")
        assert results.studies() == ["speeds"]
        table = results.study("speeds", "speed>0.1 m/s", columns=["speed", "rolling_resistance"])
        rows = table.to_dict("records") if hasattr(table, "columns") else table
        assert rows
        for row in rows:
            alone = rollres.solve(CYLINDER, tolerance=1e-6, speed=row["speed"])
            assert row["rolling_resistance"] == alone.rolling_resistance
        assert "did you mean speed?" in refusal(lambda: results.query("sped>1"))
        found = rollres.fit(EXAMPLES / "fit_cylinder.json", profiles=False)
        assert found.status.startswith(("GOOD", "USABLE"))
        assert {one.name for one in found.parameters} == {"static_shear_modulus", "stiffening", "creep_time"}
        fits = folder + "/fits.db"
        rollres.fit(EXAMPLES / "fit_cylinder.json", fits, profiles=False)
        asked = {"load [kN/m]": [15, 15], "speed [m/s]": [0.05, 0.5]}
        for predicted in (rollres.predict("fit_cylinder", asked, fits),
                          rollres.predict(EXAMPLES / "fit_cylinder.json", rollres.Scene(CYLINDER), fits)):
            for row in predicted.to_dict("records") if hasattr(predicted, "columns") else predicted:
                assert row["lowest"] < row["value"] < row["highest"]
        assert "holds no fit of this name" in refusal(lambda: rollres.predict("no fit", asked, fits))
    assert "solve" in rollres.command("manual")


def documentation():
    """Docstrings and stubs name every quantity with its unit."""
    stubs = (pathlib.Path(rollres.__file__).parent / "__init__.pyi").read_text(encoding="utf-8")
    classes = {node.name: {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
               for node in ast.parse(stubs).body if isinstance(node, ast.ClassDef)}
    for kind, owner in (("inputs", "Scene"), ("outputs", "Result")):
        for key, _, meaning, _ in rollres.quantities(kind):
            assert key in classes[owner] and getattr(getattr(rollres, owner), key).__doc__ == meaning
            assert f"{key}: {meaning}" in rollres.solve.__doc__
    assert "speed: V: speed of the body along +x [m/s]" in rollres.Scene.__doc__
    functions = {node.name for node in ast.parse(stubs).body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(rollres.__all__) <= functions
    for owner in (rollres.Objective, rollres.Database, rollres.Scene, rollres.Result):
        public = {name for name in vars(owner) if not name.startswith("_")}
        assert public <= classes[owner.__name__], public - classes[owner.__name__]


def memory():
    """Flat over many solutions: a thousand take no more than 3 MB beyond the thousand before."""
    base = rollres.Scene(CYLINDER, tolerance=1e-2)

    def resident():
        gc.collect()
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * resource.getpagesize()
    for i in range(int(sys.argv[2]) if len(sys.argv) > 2 else 2000):
        if i == 1000:
            before = resident()
        rollres.solve(base, speed=0.01 + 1e-6 * i).fields
    grown = (resident() - before) / 1e6
    print(f"grown by {grown:.2f} MB", file=sys.stderr)
    assert grown < 3


def answers():
    """Prints outputs of scenes as JSON: answers FILE..."""
    print(json.dumps([{key: value for key, value in rollres.solve(file).to_dict().items() if value == value}
                      for file in sys.argv[2:]]))


globals()[sys.argv[1]]()
