"""How far measurements bound a material, by sampling its posterior as emcee does: walkers that stretch towards each other
(Goodman and Weare, 2010), a generation solved at once.
"""

import pathlib

import numpy as np

import rollres

examples = pathlib.Path(__file__).resolve().parents[1]
scene = rollres.Scene(examples / "paper_cylinder.json", spacing=None)
keys = ["static_shear_modulus", "creep_time"]

# %% Measured at five speeds, each with an error of 2 %
speeds, sigma = [0.003, 0.01, 0.03, 0.1, 0.3], 0.02
random = np.random.default_rng(3)
measured = [result.rolling_resistance * (1 + sigma * random.normal())
            for result in rollres.solve_many([{"speed": speed} for speed in speeds], base=scene)]


def log_likelihood(points):
    """Of logarithms of the parameters, all points in one call."""
    scenes = [{**dict(zip(keys, np.exp(point))), "speed": speed} for point in points for speed in speeds]
    results = rollres.solve_many(scenes, base=scene)
    resistance = np.array([result.rolling_resistance for result in results]).reshape(len(points), len(speeds))
    misfit = (resistance / measured - 1) / sigma
    return np.nan_to_num(-0.5 * (misfit**2).sum(axis=1), nan=-np.inf)


walkers, steps, burn_in = 10, 40, 10
points = np.log([3e6, 0.25]) + 0.02 * random.normal(size=(walkers, 2))
likelihood = log_likelihood(points)
kept = []
for step in range(steps):
    for half in (slice(0, None, 2), slice(1, None, 2)):
        others = points[1::2] if half.start == 0 else points[0::2]
        stretch = (1 + random.random(walkers // 2)) ** 2 / 2
        chosen = others[random.integers(walkers // 2, size=walkers // 2)]
        proposed = chosen + stretch[:, None] * (points[half] - chosen)
        new = log_likelihood(proposed)
        accepted = np.log(random.random(walkers // 2)) < np.log(stretch) + new - likelihood[half]
        points[half] = np.where(accepted[:, None], proposed, points[half])
        likelihood[half] = np.where(accepted, new, likelihood[half])
    if step >= burn_in:
        kept.append(points.copy())
sample = np.concatenate(kept)

# %% The program's own answer: the least misfit with its standard errors
data = {"speed [m/s]": speeds, "rolling_resistance [N/m]": measured, "sigma [%]": [100 * sigma] * len(speeds)}
own = rollres.fit({"fit": "own", "scene": scene, "parameters": {key: {"start": getattr(scene, key)} for key in keys}},
                  data=data, profiles=False)
for key, values, parameter in zip(keys, np.exp(sample).T, own.parameters):
    value, error = parameter.value, parameter.standard_error
    print(f"{key}: {values.mean():.6g} +- {values.std():.2g}, rollres fit {value:.6g} +- {error:.2g}")
    assert abs(values.mean() - value) < 0.5 * error  # of 300 points, one in ten of which tells something new
    assert 0.6 < values.std() / error < 1.6
