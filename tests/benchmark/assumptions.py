"""What assumptions cost, as stated and in truth: draws cylinders and spheres on one layer, lifts an assumption and solves again.

    python3 tests/benchmark/assumptions.py build/release/rollres inertia 60 1     (assumption, scenes, seed)
    python3 tests/benchmark/assumptions.py build/release/rollres rigid 60 1
    python3 tests/benchmark/assumptions.py build/release/rollres flat 60 1

Prints for each scene the change stated and the true one, and how many are within a factor of two, or of two of the
scatter stated (and of what the numbers' own errors leave open). What `linearity.py fit` prints is the same of small strains.
"""

import json
import math
import random
import re
import subprocess
import sys

THICKNESS, DENSITY = 5e-3, 1000
STEEL = {"material": "elastic", "static_shear_modulus": 81e9, "poisson_ratio": 0.3}


def drawn(source, assumption):
    """A scene with an approach, and what lifts the assumption."""

    def between(low, high):
        return math.exp(source.uniform(math.log(low), math.log(high)))

    if assumption == "flat":
        return covered(source, between)
    half = between(0.1, 4) * THICKNESS
    radius, modulus, speed = min(half * between(3, 40), 0.9), between(1e6, 5e7), between(0.01, 30)
    if assumption == "inertia":
        speed = math.sqrt(between(1e-3, 0.5) * modulus / DENSITY)
        lifted = {"inertia": "on"}
    else:
        modulus = between(1e7, 3e9)
        lifted = {"lower_layers": [STEEL | {"layer_thickness": "infinite"}],
                  "coating_layers": [STEEL | {"layer_thickness": 0.6 * radius}]}
    return {"indenter": source.choice(["cylinder", "cylinder", "sphere"]), "radius": radius,
            "layer_thickness": THICKNESS, "static_shear_modulus": modulus, "stiffening": between(0.3, 10),
            "creep_time": half / speed * between(0.05, 20), "speed": speed, "layer_density": DENSITY,
            "poisson_ratio": source.choice([0.5, 0.5, source.uniform(0.3, 0.5)]), "inertia": "off",
            "approach": min(half**2 / (2 * radius) / source.uniform(0.7, 1.3), 0.3 * THICKNESS), "time_limit": 20}, lifted


def covered(source, between):
    """A cover on a hard base. Inertia of a density of next to nothing leaves it flat, without inertia it is a ring."""
    ratio = between(0.02, 0.6)
    radius = THICKNESS / ratio
    half = min(between(0.1, 3) * THICKNESS, 0.25 * radius)
    modulus, speed = between(1e6, 5e7), between(0.01, 10)
    cover = {"layer_thickness": THICKNESS, "static_shear_modulus": modulus, "stiffening": between(0.3, 10),
             "creep_time": half / speed * between(0.05, 20), "layer_density": 1e-6,
             "poisson_ratio": source.choice([0.5, 0.5, source.uniform(0.3, 0.5)])}
    return {"indenter": "cylinder", "radius": radius, "speed": speed, "coating_layers": [cover],
            "layer_thickness": "infinite", "material": "elastic", "static_shear_modulus": 1e12, "poisson_ratio": 0.5,
            "friction_coefficient": source.choice([0, 0.3]), "layer_density": 1e-6, "inertia": "on",
            "tolerance": 1e-3, "time_limit": 20,
            "load": modulus * half**2 / radius * min(1, THICKNESS / half)}, {"inertia": "off"}


def stated(solution, name):
    """The change that an answer states and its scatter, in numbers; None where it is told as a bound or as not known."""
    for line in solution["assumptions"]:
        found = re.fullmatch(re.escape(name) + r" .*: without it R_r ([+-][0-9.e+-]+) % \+- ([0-9.e+-]+) %", line)
        if found:
            return float(found[1]) / 100, float(found[2]) / 100
    return None


def main(program, assumption, count, seed):
    served = subprocess.Popen([program, "serve", "--jobs", "1"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def solve(scene):
        print(json.dumps(scene), file=served.stdin, flush=True)
        return json.loads(served.stdout.readline())

    name = {"inertia": "no inertia", "rigid": "rigid body and base", "flat": "flat coating"}[assumption]
    source, within, judged = random.Random(seed), 0, 0
    for _ in range(count):
        scene, lifted = drawn(source, assumption)
        on_steel = assumption == "rigid" and scene["indenter"] == "cylinder"  # there an approach means nothing
        if "approach" in scene and (on_steel or source.random() < 0.5):
            pressed = solve(scene)
            if pressed.get("status") != "converged":
                continue
            del scene["approach"]
            scene["load"] = pressed["load"]
        with_it, without = solve(scene), solve(scene | lifted)
        if with_it.get("status") != "converged" or without.get("status") != "converged":
            continue
        change, told = without["rolling_resistance"] / with_it["rolling_resistance"] - 1, stated(with_it, name)
        if told is None:
            continue
        value, scatter = told
        open_by = 2 * scatter + 3 * (with_it["error_estimate"] + without["error_estimate"])
        good = 0.5 <= change / value <= 2 or abs(change - value) <= open_by
        judged, within = judged + 1, within + good
        print(f"{scene['indenter']:9} true {change:+.3g} stated {value:+.3g} +- {scatter:.2g}{'' if good else '  <---'}")
    print(f"{assumption}: {within} of {judged} within a factor of two")


main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
