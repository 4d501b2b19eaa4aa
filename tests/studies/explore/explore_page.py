"""What a stranger does on the page of `rollres explore`, in a browser, and what others try at its port:
explore_page.py PROGRAM BROWSER. Times are printed; nothing is asserted of them."""

import http.client
import json
import os
import signal
import socket
import statistics
import subprocess
import sys
import time

from browser import Browser

PROGRAM, BROWSER = sys.argv[1:3]


def started(*words):
    process = subprocess.Popen([PROGRAM, "explore", "--no-browser", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    address = process.stdout.readline().strip()
    assert address.startswith("http://127.0.0.1:"), (address, process.stderr.read() if process.poll() is not None else "")
    return process, address


def text(browser, selector):
    return browser.value(f"document.querySelector({json.dumps(selector)}).textContent")


def moved(browser, key, share):
    """Moves a slider to a share of its way; waits for the answer."""
    before = browser.value("rollres.measured.events.length")
    browser.value(f"""(() => {{ const one = document.querySelector('.input[data-key={key}] input[type=range]');
        one.value = Number(one.min) + {share} * (one.max - one.min); one.dispatchEvent(new Event('input')); }})()""")
    browser.until(f"rollres.measured.events.length > {before}")


def of_command_line(scene, *options):
    with open("taken.json", "w") as file:
        file.write(scene)
    run = subprocess.run([PROGRAM, "solve", "taken.json", "--json", *options], capture_output=True, text=True)
    return json.loads(run.stdout)


def same_as_command_line(browser):
    """The numbers that the page shows are those of `rollres solve` to the scene file that it gives."""
    browser.choose("#take-as", "scene")
    answer = of_command_line(text(browser, "#taken"))
    browser.value("document.querySelector('#numbers').closest('details').open = true")
    shown = browser.value("""Object.fromEntries([...document.querySelectorAll('#numbers tbody tr')].map((row) =>
        [row.cells[0].textContent, JSON.parse(row.cells[2].dataset.value)]))""")
    for key, value in shown.items():
        assert key == "seconds" or answer[key] == value, (key, answer[key], value)
    assert len(shown) > 20


def scene_from_nothing(browser):
    for key, value in {"radius": "30 mm", "layer_thickness": "4 mm", "static_shear_modulus": "2 MPa", "stiffening": "0.5",
                       "creep_time": "10 ms", "speed": "3 km/h", "load": "5 kN/m"}.items():
        browser.write(f".input[data-key={key}] input", value)
    browser.until("document.querySelector('#headline').textContent.startsWith('R_r')")
    browser.until("!document.querySelector('.refused') && rollres.idle()")
    same_as_command_line(browser)
    browser.write(".input[data-key=load] input", "5 kg")
    browser.until("document.querySelector('.input[data-key=load].refused .said')")
    assert "load" in text(browser, ".input[data-key=load] .said")
    assert text(browser, "#headline") == "no answer" and browser.value("document.querySelector('#results').matches('.stale')")
    browser.write(".input[data-key=load] input", "5 kN/m")
    browser.until("!document.querySelector('.refused') && rollres.idle() && !document.querySelector('.stale')")


def three_compounds(browser):
    for stiffening in ("0.5", "1", "2"):
        browser.write(".input[data-key=stiffening] input", stiffening)
        browser.until("rollres.idle()")
        if stiffening != "2":
            browser.click("#pin")
    assert browser.value("document.querySelectorAll('#curve .curve').length") == 3
    assert "f = 0.5" in text(browser, "#curve") and "f = 2 (now)" in text(browser, "#curve")


def speed_of_largest_resistance(browser):
    words = text(browser, "#peak")
    assert words.startswith("Peak of 61 points: ") and "at speed" in words, words
    browser.choose("#take-as", "csv")
    rows = [line.split(",") for line in text(browser, "#taken").split("\n")[1:] if line]
    best = max(rows, key=lambda row: float(row[1]))
    browser.choose("#take-as", "scene")
    answer = of_command_line(text(browser, "#taken"), "--set", "speed=" + best[0] + " m/s")
    assert answer["rolling_resistance"] == float(best[1]), (answer["rolling_resistance"], best)


def study_run_and_stored(browser):
    browser.value("document.querySelector('#run').closest('details').open = true")
    browser.write("#study-points", "9")
    browser.choose("#study-second", "load")
    browser.write("#study-values", "2 kN/m, 4 kN/m")
    browser.click("#run")
    browser.until("document.querySelector('#runs').textContent.includes('18 of 18 points')")
    browser.choose("#take-as", "study")
    assert json.loads(text(browser, "#taken")) == json.load(open("explored.json"))


def study_stopped_and_resumed(browser):
    browser.choose("#study-second", "")
    browser.write("#study-name", "long")
    browser.write("#study-points", "4000")
    words = "[...document.querySelectorAll('#runs li')].find((one) => one.textContent.startsWith('long'))"
    browser.click("#run")
    browser.until(words + "?.textContent.includes('of 4000 points')")
    browser.value(words + ".querySelector('button').click()")
    browser.until(words + "?.textContent.includes('interrupted')")
    assert "4000 of 4000" not in browser.value(words + ".textContent")
    browser.click("#run")
    browser.until("/4000 of 4000 points.* recalled/.test(" + words + "?.textContent)")
    recalled = int(browser.value(words + ".textContent").split(" recalled")[0].split(" ")[-1])
    assert 0 < recalled < 4000, recalled


def worst_point_of_a_study(browser):
    browser.click("#runs button")
    browser.until("document.querySelectorAll('#study-chart .curve').length === 2")
    browser.until("document.querySelectorAll('#rows tbody tr').length === 18")
    head = "[...document.querySelectorAll('#rows th button')].find((one) => one.textContent.startsWith('rolling_resistance ['))"
    for order in ("ascending", "descending"):
        browser.value(head + ".click()")
        browser.until(f"{head}?.parentElement.ariaSort === '{order}'")
    worst = browser.value("[...document.querySelectorAll('#rows tbody tr td')].slice(0, 4).map((one) => one.textContent)")
    browser.click("#rows tbody tr button")
    browser.until("!document.querySelector('#view-scene').hidden && rollres.idle()")
    same_as_command_line(browser)
    shown = browser.value("JSON.parse([...document.querySelectorAll('#numbers tbody tr')][0].cells[2].dataset.value)")
    browser.click("#tab-studies")
    browser.until("document.querySelectorAll('#study-chart circle').length === 18")
    mark = browser.value("""(() => { const one = document.querySelectorAll('#study-chart circle')[12];
        one.dispatchEvent(new Event('click')); return one.textContent; })()""")  # the fourth of the second load
    browser.until("!document.querySelector('#view-scene').hidden && rollres.idle()")
    scene = json.loads(text(browser, "#taken"))
    assert scene["load"] == 4000, scene
    assert abs(scene["speed"] / float(mark.split(" at ")[1]) - 1) < 1e-3, (mark, scene)
    assert any(abs(shown / 10**power / float(worst[3]) - 1) < 1e-4 for power in (-6, -3, 0, 3, 6)), (shown, worst)


def layers_and_sphere(browser):
    browser.value("[...document.querySelectorAll('#inputs button')].find((one) => one.textContent === 'Add to lower layers').click()")
    browser.until("document.querySelector('.input[data-key=\"lower_layers[0].layer_thickness\"]') && rollres.idle()")
    same_as_command_line(browser)
    browser.value("document.querySelector('[aria-label=\"Remove lower_layers 0\"]').click()")
    browser.choose(".input[data-key=indenter] select", "sphere")
    browser.write(".input[data-key=load] input", "20 N")
    browser.until("/ [mµ]?N(, a first look)?$/.test(document.querySelector('#headline').textContent) && rollres.idle()")
    same_as_command_line(browser)
    started = time.monotonic()
    for step in range(40):  # nobody waits for one before the next
        browser.value(f"""(() => {{ const one = document.querySelector('.input[data-key=load] input[type=range]');
            one.value = -0.5 + {step} / 40; one.dispatchEvent(new Event('input')); }})()""")
    browser.until("rollres.idle() && !document.querySelector('#headline').textContent.includes('first look')")
    print(f"sphere: 40 moves and the last answer {time.monotonic() - started:.2f} s")
    same_as_command_line(browser)


def looks(browser):
    """At three widths, light and dark: nothing wider than the page, every field with a name, no text too pale."""
    for width in (400, 1400, 3840):
        for dark in (False, True):
            browser.size(width, 900, dark)
            found = browser.value("""(() => {
              const found = [];
              if (document.documentElement.scrollWidth > innerWidth) found.push('wider than the page: ' + document.documentElement.scrollWidth);
              for (const one of document.querySelectorAll('input, select, button, iframe, svg[role=img]'))
                if (!one.ariaLabel && !one.getAttribute('aria-label') && !one.labels?.length && !one.textContent.trim() && !one.title) found.push('no name: ' + one.outerHTML.slice(0, 90));
              const light = (colour) => { const parts = colour.match(/[0-9.]+/g).slice(0, 3).map((part) => { const share = part / 255; return share <= 0.04 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4; });
                return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]; };
              for (const one of document.querySelectorAll('p, label, td, th, button, summary, h1, h2, legend, text')) {
                if (!one.textContent.trim() || !one.checkVisibility?.()) continue;
                let behind = one; while (behind && /rgba\\(0, 0, 0, 0\\)|transparent/.test(getComputedStyle(behind).backgroundColor)) behind = behind.parentElement;
                const look = getComputedStyle(one), a = light(one.localName === 'text' ? look.fill : look.color), b = light(getComputedStyle(behind ?? document.body).backgroundColor);
                if ((Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5) found.push('pale: ' + one.textContent.trim().slice(0, 40));
              }
              return found.slice(0, 5); })()""")
            assert not found, (width, dark, found)
    browser.size(1400, 1000)


def strangers(address, process):
    """What others send to the port: refused with 4xx, and the server goes on with the memory that it had."""
    host, token = address[7:].split("/")[:2]

    def memory():
        return int(next(line for line in open(f"/proc/{process.pid}/status") if line.startswith("VmRSS")).split()[1]) / 1024

    def status(path, method="GET", body=None, **headers):
        connection = http.client.HTTPConnection(host, timeout=30)
        connection.request(method, path, body, headers)
        reply = connection.getresponse()
        reply.read()
        connection.close()
        return reply.status

    good = f"/{token}/start"
    assert status(good) == 200
    assert status(good, Host="evil.example") == 403
    assert status(good, Origin="http://evil.example") == 403
    assert status("/" + "0" * 32 + "/start") == 403
    assert status(f"/{token}/../../../etc/passwd") in (403, 404)
    assert status(f"/{token}/%2e%2e/%2e%2e/etc/passwd") in (403, 404)
    assert status("/" + "a" * 4000) == 414
    assert status(good, "DELETE") == 405
    assert status(f"/{token}/answer", "POST", "x" * 2_000_000) == 413
    for hostile in ("{", "[]", '{"wish": {"page": "a", "view": "b", "number": -1}}', "[" * 100000):
        assert status(f"/{token}/answer", "POST", hostile) == 400
    assert status(f"/{token}/answer", "POST", '{"scene": 1}') == 200  # refused in words, as any scene
    assert status(f"/{token}/nowhere", "POST", "{}") == 404
    before, open_ones = memory(), []
    for _ in range(40):  # they say half of what they want and wait
        one = socket.create_connection(host.split(":"))
        one.sendall(b"POST /" + token.encode() + b"/answer HTTP/1.1\r\nHost: " + host.encode() + b"\r\nContent-Length: 100000\r\n\r\n{")
        open_ones.append(one)
    began = time.monotonic()
    for _ in range(1000):
        assert status(good if _ % 2 else "/x") in (200, 403)
    print(f"1,000 requests beside 40 half-open ones: {time.monotonic() - began:.1f} s, memory {before:.0f} to {memory():.0f} MB")
    for one in open_ones:
        one.close()
    assert memory() < before + 100
    assert process.poll() is None


def main():
    process, address = started("--db", "results.db")
    browser = Browser(BROWSER)
    try:
        browser.open(address)
        browser.until("document.documentElement.dataset.ready")
        for key in ("load", "speed", "layer_thickness", "friction_coefficient"):
            browser.value("rollres.measured.events.length = 0")
            for step in range(12):
                moved(browser, key, 0.4 + 0.01 * step)
            times = browser.value("rollres.measured.events")
            print(f"{key}: from the event to numbers and a curve of 61 points, median {statistics.median(times):.0f} ms, largest {max(times):.0f} ms")
        same_as_command_line(browser)
        for task in (scene_from_nothing, three_compounds, speed_of_largest_resistance, study_run_and_stored, worst_point_of_a_study, study_stopped_and_resumed,
                     layers_and_sphere, looks):
            began = time.monotonic()
            task(browser)
            print(f"{task.__name__.replace('_', ' ')}: {time.monotonic() - began:.1f} s")
        assert browser.complaints() == [], browser.complaints()
        strangers(address, process)
    finally:
        browser.end()
    process.send_signal(signal.SIGINT)
    assert process.wait(10) == 0, process.stderr.read()


if __name__ == "__main__":
    main()
