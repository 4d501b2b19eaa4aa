"""Scenes by the workers of a pool: pools.py [processes|joblib|dask]. The answers are those of one process."""

import sys

import rollres


def by_processes(scenes):
    from concurrent.futures import ProcessPoolExecutor
    with ProcessPoolExecutor() as pool:
        return rollres.solve_many(scenes, map=pool.map)


def by_joblib(scenes):
    from joblib import Parallel, delayed
    return rollres.solve_many(scenes, map=lambda solve, all: Parallel(n_jobs=2)(delayed(solve)(one) for one in all))


def by_dask(scenes):
    from dask.distributed import Client
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        return rollres.solve_many(scenes, map=client.map)


def main(pool="processes"):
    mat = rollres.Scene(radius="20 mm", layer_thickness="5 mm", static_shear_modulus="3 MPa", stiffening=1,
                        creep_time="0.25 s", speed="50 mm/s", load="20 kN/m", friction_coefficient=0.2, tolerance=1e-6)
    scenes = [mat.replace(speed=0.001 * 1.04**i) for i in range(200)]
    answers = {"processes": by_processes, "joblib": by_joblib, "dask": by_dask}[pool](scenes)
    highest = max(answers, key=lambda answer: answer.rolling_resistance)
    print(f"{len(answers)} scenes; most resistance: {highest.rolling_resistance:.1f} N/m at {highest.scene.speed:.3f} m/s")

    def row(answer):
        return repr({key: value for key, value in answer.to_dict().items() if key != "seconds"})
    assert [row(one) for one in answers] == [row(one) for one in rollres.solve_many(scenes)]


if __name__ == "__main__":  # processes of a pool read this file, too
    main(*sys.argv[1:])
