"""The material of a layer from measured rolling resistances, by lmfit: the fit of fit_cylinder.json."""

import pathlib

import lmfit
import numpy as np

import rollres

examples = pathlib.Path(__file__).resolve().parents[1]

# %% Load, speed and resistance, each with an error of 2 %
load, speed, resistance, sigma = np.genfromtxt(examples / "fit_cylinder.csv", delimiter=",", skip_header=3).T
load *= 1e3

# %% The scene on continuous edges, without the example's grid
scene = rollres.Scene(examples / "paper_cylinder.json", spacing=None)


def residuals(parameters):
    material = {key: value.value for key, value in parameters.items()}
    results = rollres.solve_many([{**material, "load": p, "speed": v} for p, v in zip(load, speed)], base=scene)
    return [(result.rolling_resistance / measured - 1) / 0.02 for result, measured in zip(results, resistance)]


start = lmfit.Parameters()
start.add("static_shear_modulus", 2e6, min=1e5, max=1e8)
start.add("stiffening", 2, min=0.01, max=100)
start.add("creep_time", 0.1, min=1e-4, max=100)
found = lmfit.minimize(residuals, start, epsfcn=1e-6, scale_covar=False)
print(lmfit.fit_report(found))

# %% The program's own answer, whose weights are relative to the measured values too
own = rollres.fit(examples / "fit_cylinder.json", profiles=False)
for parameter in own.parameters:
    value, error = parameter.value, parameter.standard_error
    print(f"rollres fit: {parameter.name} = {value:.6g} +- {error:.2g}")
    assert abs(found.params[parameter.name].value - value) < 0.05 * error
    assert abs(found.params[parameter.name].stderr / error - 1) < 0.1
