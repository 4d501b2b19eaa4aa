"""The layer that rolls most easily under a limit of pressure, by scipy: the design problem of
optimise_layer.json with more friction."""

import json
import pathlib
import tempfile

import scipy.optimize

import rollres

examples = pathlib.Path(__file__).resolve().parents[1]

# %% Resistance and pressure as functions of thickness and modulus, with gradients that suit their noise
ranges = {"layer_thickness": (1e-3, 20e-3), "static_shear_modulus": (0.5e6, 30e6)}
scene = rollres.Scene(examples / "paper_cylinder.json", spacing=None, friction_coefficient=0.5)
resistance = rollres.objective(scene, ranges, order=2).scaled
pressure = rollres.objective(scene, ranges, "peak_pressure", order=2).scaled
limit = 4e6
found = scipy.optimize.minimize(
    lambda x: resistance(x) / 200, resistance.x0, jac=lambda x: resistance.gradient(x) / 200, bounds=resistance.bounds,
    constraints={"type": "ineq", "fun": lambda x: 1 - pressure(x) / limit, "jac": lambda x: -pressure.gradient(x) / limit},
    method="SLSQP", options={"ftol": 1e-10})
thickness, modulus = resistance.values(found.x)
print(f"scipy: {200 * found.fun:.2f} N/m with {thickness * 1e3:.3f} mm of {modulus / 1e6:.3f} MPa, {found.nit} iterations")

# %% The program's own answer
problem = json.loads((examples / "optimise_layer.json").read_text(encoding="utf-8"))
problem["scene"], problem["set"] = str(examples / problem["scene"]), {"tolerance": 1e-8, "friction_coefficient": 0.5}
with tempfile.TemporaryDirectory() as folder:
    (study := pathlib.Path(folder) / "layer.json").write_text(json.dumps(problem), encoding="utf-8")
    own = json.loads(rollres.command("optimise", study, "--db", folder + "/own.db", "--json"))
print(f"rollres optimise: {own['value']:.2f} N/m")
assert abs(200 * found.fun / own["value"] - 1) < 1e-4
