"""Rolling resistance against speed for three loads, drawn with matplotlib: speed_resistance.py [PICTURE]

The study file speed_resistance.json asks the same of the program; both have the same numbers to the last bit.
"""

import pathlib
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import rollres

examples = pathlib.Path(__file__).resolve().parents[1]

# %% A scene, and what varies of it
scene = rollres.Scene(radius="2 cm", layer_thickness="5 mm", static_shear_modulus="3 MPa", stiffening=1,
                      creep_time="0.25 s", friction_coefficient=0.2, speed="1 m/s", load="20 kN/m")
speeds = np.geomspace(1e-3, 10, 25)
loads = [10e3, 20e3, 40e3]
results = rollres.solve_many([{"speed": speed, "load": load} for load in loads for speed in speeds], base=scene)

# %% Drawn
resistance = np.array([result.rolling_resistance for result in results]).reshape(len(loads), len(speeds))
for load, row in zip(loads, resistance):
    plt.semilogx(speeds, row, label=f"{load / 1e3:.0f} kN/m")
plt.xlabel("speed [m/s]")
plt.ylabel("rolling resistance [N/m]")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "speed_resistance.png")
peak = speeds[resistance[1].argmax()]
print(f"20 kN/m: largest resistance {resistance[1].max():.1f} N/m at {peak:.2g} m/s")

# %% The program's own answer: a sweep over the same points
with tempfile.TemporaryDirectory() as folder:
    study = {"study": "speeds", "scene": scene, "axes": {"load": loads, "speed": list(speeds)}}
    rollres.sweep(study, folder + "/results.db")
    stored = rollres.open(folder + "/results.db").sql("SELECT rolling_resistance FROM resistance ORDER BY position")
    if hasattr(stored, "columns"):
        stored = stored.to_dict("records")
    assert [row["rolling_resistance"] for row in stored] == list(resistance.ravel())
