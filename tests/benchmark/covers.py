"""Whether covers with friction lose inside what their surface gives them: draws coated cylinders, rigid bases and yielding
ones, one cover or two, every drive, solves each with `interior: on` and compares R_r V with the losses inside, which follow
from the tractions alone, harmonic by harmonic, and the friction's.

    python3 tests/benchmark/covers.py build/release/rollres 60 1        (scenes, seed)
"""

import json
import math
import random
import subprocess
import sys

RADIUS = 0.05


def drawn(source):
    """A scene; None where the contact would be wider than a fifth of the radius."""

    def between(low, high):
        return math.exp(source.uniform(math.log(low), math.log(high)))

    thickness, modulus, speed = RADIUS * between(0.03, 0.6), between(3e5, 1e7), between(0.05, 5)
    half = thickness * between(0.1, 2)
    if half > 0.2 * RADIUS:
        return None

    def rubber(stiffer, longest):
        return {"static_shear_modulus": modulus * stiffer, "stiffening": between(0.2, 10),
                "creep_time": min(half / speed * between(0.02, 20), longest),
                "poisson_ratio": source.choice([0.5, 0.5, 0.45, 0.35])}

    load, friction = 1.5 * modulus * half**2 / RADIUS * (1 + half / thickness) ** 2, between(0.05, 1.2)
    base = {"layer_thickness": "infinite" if source.random() < 0.6 else between(2e-3, 3e-2)}
    base |= {"material": "elastic", "static_shear_modulus": 1e4 * modulus} if source.random() < 0.5 else rubber(
        between(0.3, 5), math.inf)
    covers = source.choice([1, 1, 1, 2])
    recovered = 0.3 * RADIUS / speed  # when a ring comes round again
    drive = source.choice(["free", "top_force", "torque", "torque", "rotation"])
    scene = {"indenter": "cylinder", "radius": RADIUS, "speed": speed, "load": load, "inertia": "off", "interior": "on",
             "friction_coefficient": friction, "drive": drive, "time_limit": 60, "tolerance": source.choice([1e-3, 1e-4]),
             "coating_layers": [rubber(between(0.3, 3) if i else 1, recovered) | {"layer_thickness": thickness / covers}
                                for i in range(covers)]}
    if drive == "torque":
        scene["driving_torque"] = source.uniform(-0.7, 0.7) * friction * load * RADIUS
    if drive == "rotation":
        scene["rotation_ratio"] = source.choice([0.0, 0.5, 1 + source.uniform(-0.03, 0.03), -1.0, 2.0])
    return base | scene


def main(program, count, seed):
    served = subprocess.Popen([program, "serve", "--jobs", "1"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    source, apart = random.Random(seed), []
    while len(apart) < count:
        scene = drawn(source)
        if not scene:
            continue
        print(json.dumps(scene), file=served.stdin, flush=True)
        answer = json.loads(served.stdout.readline())
        if answer.get("status") != "converged":
            continue
        power = answer["rolling_resistance"] * scene["speed"]
        missed = abs((answer["interior_loss"] + answer["frictional_loss"]) / power - 1)
        apart.append(missed)
        if missed > max(1e-3, answer["error_estimate"]):
            print(f"{missed:.1e}, where {answer['error_estimate']:.1e} is stated:", json.dumps(scene))
    apart.sort()
    print(f"{count} covers: R_r V and the losses inside are", ", ".join(
        f"{apart[math.ceil(part * count) - 1]:.1e} ({100 * part:.0f} %)" for part in (0.5, 0.9, 1)), "apart")


main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
