"""What linearity costs: draws cylinders on one layer and covered cylinders on hard ground, solves each by the linear theory
and at finite strain under the same load and under the same approach, and fits ln(R_r finite / R_r linear) by the limits
of core/estimate/linearity_error.hpp.

    python3 tests/benchmark/linearity.py draw build/release/rollres layer 220 1 >>pairs.jsonl    (kind, scenes, seed)
    python3 tests/benchmark/linearity.py draw build/release/rollres ring 300 2 >>pairs.jsonl
    python3 tests/benchmark/linearity.py draw build/release/rollres thick 70 3 >>pairs.jsonl
    python3 tests/benchmark/linearity.py fit pairs.jsonl                                         (needs numpy)

`fit` prints the factors as linearity_error.cpp has them, and what they miss of the pairs left out in turn.
"""

import json
import math
import random
import subprocess
import sys

THICKNESS, MODULUS, SPEED = 5e-3, 3e6, 0.05  # any: the answer depends on ratios only
TOLERANCE = 3e-3


def drawn(source, kind):
    """A scene: half-length a/H and approach d/H are near the ones drawn; None where they do not fit together."""

    def between(low, high):
        return math.exp(source.uniform(math.log(low), math.log(high)))

    half, approach, offset = between(0.12, 4) * THICKNESS, between(0.008, 0.3) * THICKNESS, source.uniform(0.6, 1.4)
    radius = half**2 / (2 * approach) / offset
    if kind == "ring":
        radius = THICKNESS / between(0.04, 0.7)
        approach = half**2 / (2 * radius) / offset
        if not 0.004 * THICKNESS < approach < 0.3 * THICKNESS:
            return None
    elif kind == "thick":
        half = between(0.02, 0.12) * THICKNESS
        radius = half / between(0.01, 0.6)
        approach = half**2 / (2 * radius) * math.log(4 * THICKNESS / half)
    if radius < 1.3 * half:
        return None
    layer = {"layer_thickness": THICKNESS, "static_shear_modulus": MODULUS,
             "poisson_ratio": source.choice([0.5, 0.5, 0.5, source.uniform(0.35, 0.5)])}
    recovered = 0.35 * radius / SPEED if kind == "ring" else math.inf  # when a ring comes round again
    if source.random() < 0.75:
        layer |= {"stiffening": between(0.1, 20), "creep_time": min(half / SPEED * between(0.02, 40), recovered)}
    else:
        time = min(half / SPEED * between(0.1, 10), 0.1 * recovered)
        layer |= {"material": "prony", "relaxation_times": [0.1 * time, time, 10 * time],
                  "relaxation_moduli": [MODULUS * between(0.1, 3) for _ in range(3)]}
    scene = {"indenter": "cylinder", "radius": radius, "speed": SPEED, "approach": approach,
             "friction_coefficient": source.choice([0, 0, between(0.05, 0.8)]),
             "drive": source.choice(["top_force", "free"]), "inertia": "off", "time_limit": 60}
    if kind != "ring":
        return scene | layer
    hard = {"material": "elastic", "static_shear_modulus": 1e5 * MODULUS, "layer_thickness": THICKNESS}
    return scene | hard | {"coating_layers": [layer]}


def draw(program, kind, count, seed):
    served = subprocess.Popen([program, "serve", "--jobs", "1"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def solve(scene):
        print(json.dumps(scene), file=served.stdin, flush=True)
        return json.loads(served.stdout.readline())

    source = random.Random(seed)
    while count > 0:
        scene = drawn(source, kind)
        if not scene:
            continue
        count -= 1
        linear = solve(scene)
        if linear.get("status") != "converged":
            continue
        finite = {"method": "finite_strain", "tolerance": TOLERANCE}
        loaded = {key: value for key, value in scene.items() if key != "approach"} | {"load": linear["load"]}
        print(json.dumps({"kind": kind, "scene": scene, "lin": linear, "fin": solve(loaded | finite),
                          "fina": solve(scene | finite)}), flush=True)


def modulus(layer, omega):
    at_rest = layer["static_shear_modulus"]
    if layer.get("material") == "prony":
        terms = zip(layer["relaxation_moduli"], layer["relaxation_times"])
        return at_rest + sum(g * 1j * omega * t / (1 + 1j * omega * t) for g, t in terms)
    time = layer["creep_time"]
    return at_rest * (1 + 1j * omega * time) / (1 + 1j * omega * time / (1 + layer["stiffening"]))


def features(pair, finite):
    """d/H, what the factors stand before and the logarithm; None where the formula is not used."""
    scene, linear, answer = pair["scene"], pair["lin"], pair[finite]
    if answer.get("status") != "converged" or not answer["rolling_resistance"] > 0 or answer["error_estimate"] > 0.01:
        return None
    layer = scene["coating_layers"][0] if pair["kind"] == "ring" else scene
    half, friction = (linear["leading_edge"] - linear["trailing_edge"]) / 2, scene["friction_coefficient"]
    omega, step = SPEED / half, 1.001
    here = modulus(layer, omega)
    slope = math.log(modulus(layer, omega * step).imag / modulus(layer, omega / step).imag) / (2 * math.log(step))
    share = linear["frictional_loss"] / (linear["rolling_resistance"] * SPEED) if friction else 0
    lever = linear["rolling_resistance"] * scene["radius"] / (linear["load"] * half)
    if share > 0.3 or (friction > 0 and lever < 0.01):
        return None
    ratio, loss, below = half / THICKNESS, here.imag / here.real, (1 + slope) / 2
    thin, strain = ratio / (1 + ratio), linear["approach"] / THICKNESS
    sheared = pair["kind"] == "ring" and friction > 0
    of_ring = half / scene["radius"] * linear["rolling_resistance"] / linear["load"] / strain if sheared else 0
    return (strain,
            [(1 - thin) * (1 - below), (1 - thin) * below, thin * (1 - below), thin * below,
             below * (1 - 2 * layer["poisson_ratio"]), loss / (1 + loss), of_ring],
            math.log(answer["rolling_resistance"] / linear["rolling_resistance"]))


def fit(pairs, finite):
    import numpy as np

    known = [found for found in (features(pair, finite) for pair in pairs) if found]
    strain, wanted = np.array([k[0] for k in known]), np.array([k[2] for k in known])
    weight = 1 / np.sqrt(2e-3**2 + (0.05 * strain) ** 2)
    matrix, right = np.array([k[1] for k in known]) * (strain * weight)[:, None], wanted * weight
    factors = np.linalg.lstsq(matrix, right, rcond=None)[0]
    q, _ = np.linalg.qr(matrix)
    missed = np.abs((right - q @ (q.T @ right)) / (1 - (q**2).sum(1)) / weight) / strain
    print(finite, len(known), "pairs:", " ".join(f"{factor:.2f}," for factor in factors))
    for low, high in ((0, 1), (0, 0.02), (0.02, 0.06), (0.06, 0.15), (0.15, 0.4)):
        some = (strain >= low) & (strain < high)
        print(f"  d/H {low} to {high}: {some.sum()}, missed over d/H (50, 68, 95, 100 %):",
              np.quantile(missed[some], [0.5, 0.68, 0.95, 1]).round(2))
    scatter = np.quantile(missed[strain > 0.02], 0.68)
    stated = np.hypot((matrix / weight[:, None]) @ factors, scatter * strain)
    print("  beyond twice what is stated:", np.mean(np.abs(wanted) > 2 * stated).round(3))


if sys.argv[1] == "draw":
    draw(sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]))
else:
    drawn_pairs = list(map(json.loads, open(sys.argv[2])))
    for kind in ("fin", "fina"):
        fit(drawn_pairs, kind)
