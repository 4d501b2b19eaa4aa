"""Pickles and pools of processes: pools.py PART. Each part prints nothing unless it fails."""

import copy
import json
import multiprocessing
import pathlib
import pickle
import sys
from concurrent.futures import Future, ProcessPoolExecutor

import rollres

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "studies" / "examples"
CYLINDER = EXAMPLES / "paper_cylinder.json"
SPHERE = dict(indenter="sphere", radius="2 cm", layer_thickness="5 mm", static_shear_modulus="3 MPa", stiffening=1,
              creep_time="0.25 s", speed="5 cm/s", load="40 N", friction_coefficient=0.2, tolerance=1e-2)
ARRAYS = [name for name, value in vars(rollres.Fields).items() if isinstance(value, property)]


def again(value):
    return pickle.loads(pickle.dumps(value))


def bits(fields):
    """Every bit of the fields."""
    return fields and [None if getattr(fields, name) is None else
                       (getattr(fields, name).shape, getattr(fields, name).tobytes()) for name in ARRAYS]


def same(one, other):
    """repr tells every bit of a number, and nan is nan."""
    assert repr(one.to_dict()) == repr(other.to_dict())
    assert one.scene == other.scene and one.summary() == other.summary() and one.json() == other.json()
    assert bits(one.fields) == bits(other.fields)


def pickles():
    """What was pickled is the same to the last bit."""
    wheel = json.loads((EXAMPLES / "warm_wheel.json").read_text())["scene"]
    wheel["coating_layers"][0]["master_curve_file"] = str(EXAMPLES / "polyurethane.csv")
    answers = [rollres.solve(CYLINDER), rollres.solve(SPHERE), rollres.solve(CYLINDER, skew_angle="1 deg", kinematics="consistent"),
               rollres.solve(CYLINDER, method="newton", spacing="0.2 mm"),
               rollres.solve(CYLINDER, layer_thickness="6 m"), rollres.solve(wheel, heat="on", speed=1, tolerance=1e-2),
               rollres.solve(CYLINDER, drive="torque", driving_torque=200), *rollres.solve_many([CYLINDER])]
    for answer in answers:
        for found in (again(answer), copy.copy(answer), copy.deepcopy(answer), again(again(answer))):
            same(answer, found)
        assert again(answer.scene) == answer.scene
        if answer.fields is not None:
            assert bits(again(answer.fields)) == bits(answer.fields)
    assert answers[0].fields is not None and answers[-1].fields is None
    small, large = (len(pickle.dumps(one)) for one in (answers[-1], answers[0]))
    assert small < large and small < 20000, (small, large)
    report = rollres.gradient(CYLINDER, "load", tolerance=1e-6)
    assert again(report) == report and again(report).inputs[0].key == "load"
    unmade = rollres.Result.__new__(rollres.Result)
    try:
        unmade.load
    except (TypeError, RuntimeError):
        return
    raise AssertionError("an answer that was never made has a load")


def objectives():
    """Objectives keep bounds and the noise that was measured."""
    f = rollres.objective(CYLINDER, {"load": (1e3, "100 kN/m"), "layer_thickness": ("2 mm", "6 m")}, tolerance=1e-6,
                          threads=2)
    fresh = again(f)
    assert fresh.bounds == f.bounds and fresh.x0 == f.x0 and fresh.names == f.names and fresh.scales == f.scales
    assert fresh(f.x0) == f(f.x0) and again(f.scaled)(f.scaled.x0) == f.scaled(f.scaled.x0)
    measured = f.value_and_gradient(f.x0)
    assert again(f).value_and_gradient(f.x0) == measured == fresh.value_and_gradient(f.x0)
    there = [1.1 * x for x in f.x0]  # by the noise at x0
    assert again(f).value_and_gradient(there) == f.value_and_gradient(there)
    assert list(again(f.scaled.gradient)(f.scaled.x0)) == list(f.scaled.gradient(f.scaled.x0))
    with pool() as processes:
        points = [[x * load for x in f.x0] for load in (0.5, 1, 1.5)]
        assert list(processes.map(f, points)) == [f(x) for x in points]
        found = f.solve_many(points, map=processes.map)
    assert [one.rolling_resistance for one in found] == [f(x) for x in points]


def pool():
    return ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))


def rows(answers):
    return [repr({key: value for key, value in one.to_dict().items() if key != "seconds"}) for one in answers]


def futures(act, items):
    """As dask's client.map."""
    done = []
    for item in items:
        done.append(Future())
        done[-1].set_result(act(item))
    return done


def processes():
    """A pool's answers are those of one process."""
    base = rollres.Scene(CYLINDER, tolerance=1e-6)
    asked = [{"speed": 0.001 * 1.04**i} for i in range(200)]
    expected = rows(rollres.solve_many(asked, base))
    told = []
    with pool() as workers:
        found = rollres.solve_many(asked, base, map=workers.map, progress=lambda done, all: told.append((done, all)))
        assert rows(found) == expected and told == [(i + 1, 200) for i in range(200)]
        assert [one.scene.speed for one in found] == [one["speed"] for one in asked] and found[0].fields is None
        with_fields, = rollres.solve_many([SPHERE], map=workers.map, fields=True)
        assert bits(with_fields.fields) == bits(rollres.solve_many([SPHERE], fields=True)[0].fields)
    assert rows(rollres.solve_many(asked[:5], base, map=futures)) == expected[:5]
    assert rows(rollres.solve_many(asked[:5], base, map=map)) == expected[:5]
    assert rollres.solve_many([], map=map) == []
    for wrong in (dict(map=map, db="no.db"), dict(map=map, threads=2), dict(map=lambda act, all: [])):
        try:
            rollres.solve_many([CYLINDER], **wrong)
        except ValueError as error:
            assert "map" in str(error)
        else:
            raise AssertionError("nothing was refused")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
