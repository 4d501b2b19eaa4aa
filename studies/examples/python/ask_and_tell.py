"""A loop that asks and tells, as Optuna's, nevergrad's and other black-box optimisers do: many designs at once, without
slopes. The search is a plain one, differential evolution, on the problem of optimise_layer.py.
"""

import json
import pathlib
import tempfile

import numpy as np

import rollres

examples = pathlib.Path(__file__).resolve().parents[1]
scene = rollres.Scene(examples / "paper_cylinder.json", spacing=None, friction_coefficient=0.5)
keys = ["layer_thickness", "static_shear_modulus"]
lowest, highest = np.log([1e-3, 0.5e6]), np.log([20e-3, 30e6])
random = np.random.default_rng(1)


def costs(designs):
    """Resistance [N/m], and much more where the pressure is beyond its limit or there is no answer."""
    results = rollres.solve_many([dict(zip(keys, np.exp(design))) for design in designs], base=scene)
    beyond = [max(0, result.peak_pressure / 4e6 - 1) if result.status == "converged" else 10 for result in results]
    return np.array([(result.rolling_resistance if excess < 10 else 0) + 1e4 * excess
                     for result, excess in zip(results, beyond)])


designs = random.uniform(lowest, highest, (12, 2))
told = costs(designs)
for generation in range(14):
    others = np.array([designs[random.choice(12, 3, replace=False)] for _ in designs])
    asked = others[:, 0] + 0.7 * (others[:, 1] - others[:, 2])
    asked = np.clip(np.where(random.random(asked.shape) < 0.9, asked, designs), lowest, highest)
    new = costs(asked)
    better = new < told
    designs[better], told[better] = asked[better], new[better]
best = rollres.solve(scene, **dict(zip(keys, np.exp(designs[told.argmin()]))))
layer = best.scene
print(f"{told.min():.2f} N/m with {layer.layer_thickness * 1e3:.3f} mm of {layer.static_shear_modulus / 1e6:.3f} MPa")

# %% The program's own answer
problem = json.loads((examples / "optimise_layer.json").read_text(encoding="utf-8"))
problem["scene"], problem["set"] = str(examples / problem["scene"]), {"tolerance": 1e-8, "friction_coefficient": 0.5}
with tempfile.TemporaryDirectory() as folder:
    (study := pathlib.Path(folder) / "layer.json").write_text(json.dumps(problem), encoding="utf-8")
    own = json.loads(rollres.command("optimise", study, "--db", folder + "/own.db", "--json"))
print(f"rollres optimise: {own['value']:.2f} N/m")
assert abs(told.min() / own["value"] - 1) < 0.02
