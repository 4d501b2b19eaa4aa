"""What linearity costs: draws cylinders on one layer, solves each by the linear theory and at finite strain under the
same load, and fits ln(R_r finite / R_r linear) to what is known of the linear answer (core/estimate/linearity_error.hpp).

    python3 tests/benchmark/linearity.py draw build/release/rollres 400 1 >>pairs.jsonl    (scenes, seed)
    python3 tests/benchmark/linearity.py fit pairs.jsonl                                   (needs numpy)

`fit` prints the terms of the polynomial as linearity_error.cpp has them, and the scatter of those left out in turn.
"""

import itertools
import json
import math
import random
import subprocess
import sys

THICKNESS, MODULUS, SPEED = 5e-3, 3e6, 0.05  # any: the answer depends on ratios only


def drawn(source):
    """A scene: half-length a/H and approach d/H are near the ones drawn."""

    def between(low, high):
        return math.exp(source.uniform(math.log(low), math.log(high)))

    half, approach = between(0.15, 4) * THICKNESS, between(0.01, 0.33) * THICKNESS
    radius = half**2 / (2 * approach) / source.uniform(0.6, 1.4)
    if radius < 1.3 * half:
        return None
    scene = {"indenter": "cylinder", "radius": radius, "layer_thickness": THICKNESS, "static_shear_modulus": MODULUS,
             "poisson_ratio": source.choice([0.5, 0.5, 0.5, source.uniform(0.35, 0.5)]), "speed": SPEED,
             "approach": approach, "friction_coefficient": source.choice([0, 0, between(0.05, 0.8)]),
             "drive": source.choice(["top_force", "free"]), "inertia": "off", "time_limit": 60}
    if source.random() < 0.75:
        return scene | {"stiffening": between(0.1, 20), "creep_time": half / SPEED * between(0.02, 40)}
    time = half / SPEED * between(0.1, 10)
    return scene | {"material": "prony", "relaxation_times": [0.1 * time, time, 10 * time],
                    "relaxation_moduli": [MODULUS * between(0.1, 3) for _ in range(3)]}


def draw(program, count, seed):
    served = subprocess.Popen([program, "serve", "--jobs", "1"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def solve(scene):
        print(json.dumps(scene), file=served.stdin, flush=True)
        return json.loads(served.stdout.readline())

    source = random.Random(seed)
    for _ in range(count):
        scene = drawn(source)
        if not scene:
            continue
        linear = solve(scene)
        if linear.get("status") != "converged":
            continue
        under_load = {key: value for key, value in scene.items() if key != "approach"} | {"load": linear["load"]}
        finite = solve(under_load | {"method": "finite_strain", "tolerance": 2e-3})
        print(json.dumps({"scene": scene, "lin": linear, "fin": finite}), flush=True)


def modulus(scene, omega):
    at_rest = scene["static_shear_modulus"]
    if scene.get("material") == "prony":
        terms = zip(scene["relaxation_moduli"], scene["relaxation_times"])
        return at_rest + sum(g * 1j * omega * t / (1 + 1j * omega * t) for g, t in terms)
    time = scene["creep_time"]
    return at_rest * (1 + 1j * omega * time) / (1 + 1j * omega * time / (1 + scene["stiffening"]))


def features(pair):
    """d/H and the variables of the polynomial, named as in linearity_error.hpp; None where the formula is not used."""
    scene, linear = pair["scene"], pair["lin"]
    if pair["fin"]["status"] != "converged" or scene.get("material") == "elastic":
        return None
    half, friction = linear["contact_area"] / 2, scene["friction_coefficient"]
    omega, step = scene["speed"] / half, 1.001
    here = modulus(scene, omega)
    slope = math.log(modulus(scene, omega * step).imag / modulus(scene, omega / step).imag) / (2 * math.log(step))
    share = linear["frictional_loss"] / (linear["rolling_resistance"] * scene["speed"])
    lever = linear["rolling_resistance"] * scene["radius"] / (linear["load"] * half)
    if share > 0.3 or (friction > 0 and lever < 0.01):
        return None
    ratio, loss, volume = half / scene["layer_thickness"], here.imag / here.real, 1 - 2 * scene["poisson_ratio"]
    return (linear["approach"] / scene["layer_thickness"],
            {"A": ratio / (1 + ratio), "U": (1 + slope) / 2, "T": loss / (1 + loss), "C": volume,
             "K": volume * ratio**2 / (0.3 + volume * ratio**2), "M": friction / (0.1 + friction),
             "S": linear["approach"] / scene["layer_thickness"]},
            math.log(pair["fin"]["rolling_resistance"] / linear["rolling_resistance"]))


def fit(file, count):
    import numpy as np

    known = [found for found in map(features, map(json.loads, open(file))) if found]
    strain, wanted = np.array([k[0] for k in known]), np.array([k[2] for k in known])
    names = list(known[0][1])
    variable = {name: np.array([k[1][name] for k in known]) for name in names}
    terms = [()] + [t for order in (1, 2, 3) for t in itertools.combinations_with_replacement(names, order)]
    weight = 1 / np.sqrt(2e-3**2 + (0.05 * strain) ** 2)
    matrix = np.array([np.prod([variable[v] for v in term], axis=0) * strain * weight for term in terms]).T
    right, size = wanted * weight, np.linalg.norm(matrix, axis=0)

    def left_out(chosen):
        q, _ = np.linalg.qr(matrix[:, chosen] / size[chosen])
        return (right - q @ (q.T @ right)) / (1 - (q**2).sum(1))

    chosen = [0]
    while len(chosen) < count:  # the term that helps those left out most
        q, _ = np.linalg.qr(matrix[:, chosen] / size[chosen])
        other = matrix / size - q @ (q.T @ (matrix / size))
        norm = np.linalg.norm(other, axis=0)
        gain = np.where(norm > 1e-3, (other.T @ right) ** 2 / np.maximum(norm, 1e-3) ** 2, 0)
        likely = [j for j in np.argsort(-gain)[:20] if j not in chosen]
        chosen.append(min(likely, key=lambda j: np.sum(left_out(chosen + [j]) ** 2)))
        for j in chosen[1:-1]:
            rest = [k for k in chosen if k != j]
            if np.sum(left_out(rest) ** 2) < np.sum(left_out(chosen) ** 2):
                chosen = rest
    factors = np.linalg.lstsq(matrix[:, chosen], right, rcond=None)[0]
    for term, factor in zip((terms[j] for j in chosen), factors):
        print(f"    {{{factor:.3f}, \"{''.join(term)}\"}},")
    missed = np.abs(left_out(chosen) / weight)
    print(len(known), "pairs; missed over d/H: 68 %, 95 %, 100 %:", np.quantile(missed / strain, [0.68, 0.95, 1]).round(3))
    for low, high in ((0, 0.03), (0.03, 0.1), (0.1, 0.2), (0.2, 0.4)):
        some = (strain >= low) & (strain < high)
        print(f"  d/H {low} to {high}:", some.sum(), np.quantile(missed[some] / strain[some], [0.5, 0.68, 0.95]).round(3))
    for name, limit in (("M", 1e-9), ("C", 1e-9), ("T", 0.3), ("U", 0.5), ("A", 0.5)):
        below = variable[name] <= limit
        for sign, some in (("<=", below), (">", ~below)):
            print(f"  {name} {sign} {limit}:", some.sum(), np.quantile(missed[some] / strain[some], [0.5, 0.68, 0.95]).round(3))


if sys.argv[1] == "draw":
    draw(sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
else:
    fit(sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 16)
