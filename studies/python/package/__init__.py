"""Rolling resistance of a rigid cylinder or sphere over viscoelastic layers.

    import rollres
    wheel = rollres.solve(radius="20 mm", layer_thickness="5 mm", static_shear_modulus="3 MPa", stiffening=1,
                          creep_time="0.25 s", speed="50 mm/s", load="20 kN/m", friction_coefficient=0.2)
    wheel.rolling_resistance   # 313.2 (N/m; in N with a width, and for a sphere)

Inputs are those of scene files: numbers in SI, or texts with a unit. Answers are numbers in SI; what is absent is nan.
Wrong input is a ValueError with the words of the command line, a file or database that fails an OSError.
"""

import html as _html
import json as _json
import math as _math
import os as _os
import tempfile as _tempfile

from . import _rollres
from ._rollres import Fields, Result, Scene, __version__

__all__ = ["Database", "Fields", "Objective", "Report", "Result", "Scene", "command", "fit", "gradient", "model",
           "objective", "open", "predict", "quantities", "solve", "solve_many", "sweep"]


def _pandas():
    try:
        import pandas
    except ImportError:
        return None
    return pandas


def _is_frame(data):
    return hasattr(data, "to_dict") and hasattr(data, "columns") and hasattr(data, "to_csv")


def _table(columns):
    """A pandas.DataFrame, or a list of dicts where there is no pandas."""
    pandas = _pandas()
    if pandas is not None:
        return pandas.DataFrame(columns)
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def _replace(self, **inputs):
    """The scene with other values of some inputs, as by --set: load takes the place of approach and so on; None: absent."""
    return self.replaced(inputs)


def _scene_dict(self):
    """The inputs that are given or have a default, as in a scene file."""
    return _json.loads(self.json())


def _scene_repr(self):
    return "Scene(" + ", ".join(f"{key}={value!r}" for key, value in self.to_dict().items()
                                if value != _DEFAULTS.get(key)) + ")"


Scene.replace = _replace
Scene.to_dict = _scene_dict
Scene.__repr__ = _scene_repr
Scene.__eq__ = lambda self, other: self.json() == other.json() if isinstance(other, Scene) else NotImplemented
Scene.__hash__ = lambda self: hash(self.json())
Scene.__reduce__ = lambda self: (Scene, (self.to_dict(),))
Scene.__doc__ = """What is asked: Scene(inputs by name), Scene(dict), Scene("file.json"), Scene(file, speed=...).

Every input is an attribute in SI. Inputs:

"""


def _scene(base, inputs):
    return base if isinstance(base, Scene) and not inputs else Scene(base, **inputs)


def solve(base=None, /, **inputs):
    """Solves one scene: inputs by name, a dict, a Scene or the name of a scene file, whose inputs others replace.

    The answer is a Result. Ctrl-C ends it.
    """
    return _rollres.solve(_scene(base, inputs))


def model(base=None, /, **inputs):
    """The model that solves a scene, before it is solved: what is taken along, what is left out, and by which method.

    Takes what `solve` takes. The answer is a Report: foundation and coating (lists of layers), flow, inertia, method,
    tolerance (left for numbers) of asked_tolerance, left_out, decisions, and the same in `words`.
    """
    return Report(_rollres.model(_scene(base, inputs)))


def _rows(scenes):
    if _is_frame(scenes):
        def given(value):
            return value is not None and not (isinstance(value, float) and _math.isnan(value))
        return [{key: value for key, value in row.items() if given(value)} for row in scenes.to_dict("records")]
    return scenes


class _SolveOne:
    """Solves one of many scenes; pickles for a pool."""

    def __init__(self, fields):
        self.fields = fields

    def __call__(self, scene):
        return _rollres.solve_one(scene, self.fields)


def _mapped(pool_map, scenes, fields, progress):
    """Results of a pool, in the order of the scenes; of dask.distributed it gives futures."""
    results = []
    for one in pool_map(_SolveOne(fields), scenes) if scenes else []:
        results.append(one if isinstance(one, Result) else one.result())
        if progress is not None:
            progress(len(results), len(scenes))
    if len(results) != len(scenes):
        raise ValueError(f"map gave {len(results)} answers to {len(scenes)} scenes")
    return results


def solve_many(scenes, base=None, *, threads=0, progress=None, fields=False, db=None, map=None):
    """Solves many scenes side by side, without Python's lock.

    scenes    a list of what `solve` takes, or a pandas.DataFrame with a column for each input
    base      a scene, dict or file whose inputs they replace
    threads   0: one for each core
    progress  called as progress(answered, all), some thirty times a second; with map after each answer
    fields    keep the fields of each answer
    db        a database: recall what is stored there, store the rest (without fields)
    map       of a pool, executor.map or dask's client.map: map(function, list) solves each scene in one thread of a worker

    The answers are Results in the order of the scenes; those without an answer have another status than "converged".
    Ctrl-C ends it within a tenth of a second; what was stored by then stays.
    """
    if base is None:
        asked = [_scene(one, {}) for one in _rows(scenes)]
    else:
        base = _scene(base, {})
        asked = [one if isinstance(one, Scene) else base.replaced(one) for one in _rows(scenes)]
    if map is not None:
        if db is not None or threads:
            raise ValueError("solve_many: map does not go with db or threads: the pool has its own workers, without a store")
        return _mapped(map, asked, fields, progress)
    return _rollres.solve_many(asked, threads, progress, fields, None if db is None else _os.fspath(db))


class Report(dict):
    """A dict whose items are attributes too."""

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self):
        return [*super().__dir__(), *self]


def _report(value):
    if isinstance(value, dict):
        return Report((key, _report(item)) for key, item in value.items())
    return [_report(item) for item in value] if isinstance(value, list) else value


def _names(given):
    """A list of names, of which one may stand alone."""
    return [given] if isinstance(given, str) else list(given)


def gradient(base, inputs, output="rolling_resistance", *, order=4, threads=0, **replaced):
    """Derivatives of an output by some inputs, with noise, errors and elasticities: the object of `rollres gradient --json`.

    inputs  names of inputs: ["load", "speed"]
    """
    return _report(_rollres.gradient(_scene(base, replaced), _names(inputs), output, order, threads))


class Objective:
    """An output as a function of some inputs, for optimisers and samplers.

        f = rollres.objective("wheel.json", {"speed": (0.1, 10), "load": None})
        scipy.optimize.minimize(f.scaled, f.scaled.x0, jac=f.scaled.gradient, bounds=f.scaled.bounds)

    A point is a list of the inputs' values in SI. Where the scene has no answer, the value is nan.
    names   keys of the inputs
    bounds  (lowest, highest) of each [SI]
    x0      the scene's own values [SI]
    scales  size of a large change of each [SI]
    scaled  the same function of scaled variables, in which a change by 1 is a large one: ln x, or x / size
    """

    def __init__(self, function, threads=0, order=4):
        self._function, self._threads, self._order = function, threads, order
        self._variables = function.variables
        self.names = [variable.key for variable in self._variables]
        self.bounds = [(variable.lowest, variable.highest) for variable in self._variables]
        self.x0 = list(function.base)
        self.scales = [abs(variable.slope(x)) for variable, x in zip(self._variables, self.x0)]
        self.scaled = _ScaledObjective(self)

    def __reduce__(self):
        return Objective, (self._function, self._threads, self._order)

    def __call__(self, x):
        return self._function.value([float(value) for value in x])

    def value_and_gradient(self, x):
        """The value, the derivatives and their estimated errors.

        The first call measures the noise: 8 to 40 solutions for each input.
        """
        return self._function.gradient([float(value) for value in x], self._order, self._threads)

    def gradient(self, x):
        """The derivatives alone."""
        return _array(self.value_and_gradient(x)[1])

    def scene(self, x):
        """The scene at a point."""
        return self._function.scene([float(value) for value in x])

    def solve_many(self, points, **options):
        """Results at many points."""
        options.setdefault("threads", 0 if options.get("map") else self._threads)
        return solve_many([self.scene(x) for x in points], **options)


class _ScaledObjective:
    def __init__(self, objective):
        self._objective = objective
        self.names = objective.names
        self.x0 = self.of(objective.x0)
        self.bounds = [tuple(variable.scaled(end) if 0 < abs(end) < _math.inf or not variable.logarithmic else None
                             for end in ends) for variable, ends in zip(objective._variables, objective.bounds)]

    def __reduce__(self):
        return getattr, (self._objective, "scaled")

    def of(self, x):
        """Scaled variables of a point in SI."""
        return [variable.scaled(value) for variable, value in zip(self._objective._variables, x)]

    def values(self, scaled):
        """The point in SI, inside its bounds."""
        return [min(max(variable.value(float(value)), low), high) for variable, value, (low, high)
                in zip(self._objective._variables, scaled, self._objective.bounds)]

    def __call__(self, scaled):
        return self._objective(self.values(scaled))

    def gradient(self, scaled):
        x = self.values(scaled)
        derivatives = self._objective.value_and_gradient(x)[1]
        return _array([derivative * variable.slope(value) for derivative, variable, value
                       in zip(derivatives, self._objective._variables, x)])


def _array(values):
    import numpy
    return numpy.array(values)


def objective(base, inputs, output="rolling_resistance", *, threads=0, order=4, **replaced):
    """An Objective: an output as a function of some inputs.

    inputs  names of inputs, or a dict of names and bounds: (lowest, highest) in SI or as texts with units, or None
    """
    bounds = inputs if isinstance(inputs, dict) else dict.fromkeys(inputs)
    choices = [(key, *(ends if ends is not None else (None, None))) for key, ends in bounds.items()]
    return Objective(_rollres.Function(_scene(base, replaced), choices, output), threads, order)


def _csv(data, name, what):
    """Writes columns, a DataFrame or a dict of lists, as a CSV file, and returns its name."""
    columns = {str(column): list(data[column]) for column in data}
    if len({len(values) for values in columns.values()}) > 1:
        raise ValueError(f"{what}: columns of different lengths: " +
                         ", ".join(f"{column} has {len(values)}" for column, values in columns.items()))
    for text in (*columns, *(str(value) for values in columns.values() for value in values)):
        if any(letter in text for letter in ",;\t\"\r\n\0"):
            raise ValueError(f"{what}: {text!r}: must have no comma, semicolon, quote, tab, line end or NUL")
    with _open(name, "w", encoding="utf-8") as file:
        for row in (columns, *zip(*columns.values())):
            file.write(",".join(str(value) for value in row) + "\n")
    return name


class _File:
    """The name of a file, or a file that holds a dict while it is used."""

    def __init__(self, content, data=None):
        self._content, self._data = content, data

    def __enter__(self):
        self.folder = _tempfile.TemporaryDirectory()
        if not isinstance(self._content, dict):
            return _os.fspath(self._content)
        content = dict(self._content)
        for key in ("scene", "data"):
            if isinstance(content.get(key), (str, _os.PathLike)):
                content[key] = _os.path.abspath(content[key])
        if self._data is not None:
            content["data"] = _csv(self._data, _os.path.join(self.folder.name, "data.csv"), "data")
        name = _os.path.join(self.folder.name, "file.json")
        with _open(name, "w", encoding="utf-8") as file:
            _json.dump(content, file, default=_plain)
        return name

    def __exit__(self, *failure):
        self.folder.cleanup()


_open = open


def _plain(value):
    """A Scene, or a number or an array of numpy, for JSON."""
    if isinstance(value, Scene):
        return value.to_dict()
    if not hasattr(value, "tolist"):
        raise TypeError(f"a value of type {type(value).__name__} is no input: give a number, a text, a list or a dict")
    return value.tolist()


def sweep(study, db, *, threads=0, progress=None, fields=False, retry="nothing"):
    """Solves the points of a study that a database lacks: a study file's name, or its content as a dict.

    The answer tells how many points there are, were recalled, solved and failed; `open(db).study(name)` has the table.
    """
    with _File(study) as name:
        return Report(_rollres.sweep(name, _os.fspath(db), threads, progress, fields, retry))


def fit(fit, db=None, *, data=None, threads=0, profiles=True):
    """Fits a scene or a material to measured values: a fit file's name, or its content as a dict.

    data  a pandas.DataFrame or a dict of columns in place of the dict's "data": named as in the CSV file, "speed [m/s]"
    db    keeps the evaluations and the fit

    The answer is the object of `rollres fit --json`.
    """
    with _tempfile.TemporaryDirectory() as folder, _File(fit, data) as name:
        words = ["fit", name, "--db", _os.path.join(folder, "fit.db") if db is None else _os.fspath(db), "--json"]
        words += ["--jobs", str(threads)] if threads else []
        return _report(_json.loads(command(*words, *([] if profiles else ["--no-profiles"]))))


def predict(fit, scenes, db=None, *, predict_as="true_value", data_set=None, data=None, threads=0):
    """What a fit says of scenes that were not measured, with 95 % intervals: a table with a row for each.

    fit         a fit file's name or its content as a dict, or the name of a fit that `db` holds
    scenes      a scene, a study or a CSV file by name, a Scene, a scene or a study as a dict, or rows in the scene of the
                fit: a pandas.DataFrame or a dict of columns, named as in the CSV file, "speed [m/s]"
    predict_as  "true_value" of the model, "reading" with offset and scale, or one more "measurement" with its noise
    data_set    whose offset, scale and noise count; default: the first
    data        as in `fit`

    Columns: the inputs, value, standard_error, lowest, highest, measured, in SI.
    """
    content = scenes.to_dict() if isinstance(scenes, Scene) else scenes
    columns = _is_frame(content) or (isinstance(content, dict) and bool(content) and
                                     all(isinstance(column, (list, tuple)) or hasattr(column, "tolist")
                                         for column in content.values()))
    with _tempfile.TemporaryDirectory() as folder, _File(fit, data) as name:
        content = _csv(content, _os.path.join(folder, "scenes.csv"), "scenes") if columns else content
        with _File(content) as asked:
            words = ["fit", name, "--db", _os.path.join(folder, "fit.db") if db is None else _os.fspath(db), "--json",
                     "--no-profiles", "--predict", asked, "--predict-as", predict_as]
            words += ["--predict-data", data_set] if data_set else []
            words += ["--jobs", str(threads)] if threads else []
            answer = _json.loads(command(*words))
    if "predictions" not in answer:
        raise ValueError(f"{answer['fit']}: {answer['status']}: {answer['reason']}: nothing can be predicted")
    rows = answer["predictions"]
    return _table({key: [row[key] for row in rows] for key in rows[0]})


def command(*words):
    """Runs a command of the program, command("verify", "--summary"), and returns what it prints.

    Exit status 2 is a ValueError, 3 an OSError; 0 and 1 are answers.
    """
    status, out, err = _rollres.command([_os.fspath(word) for word in words])
    if status >= 2:
        message = err.strip().splitlines()[-1].removeprefix("rollres: ")
        raise (ValueError if status == 2 else OSError)(message)
    return out


class Database:
    """Stored results. Tables are pandas.DataFrames, or lists of dicts where there is no pandas."""

    def __init__(self, file):
        self.file = _os.fspath(file)
        self.sql("SELECT 1")

    def query(self, *filters, columns=(), sort=(), limit=None):
        """Rows that meet filters as `rollres query` takes them: query("speed>0.1", "load=20 kN/m", sort=["-speed"])."""
        return _table(_rollres.query(self.file, list(filters), _names(columns), _names(sort), limit))

    def study(self, name, *filters, **options):
        """The rows of a study, in its order."""
        return self.query(f"study={name}", *filters, **{"sort": ["position"], **options})

    def studies(self):
        """Names of the studies."""
        return list(_rollres.sql(self.file, "SELECT name FROM study ORDER BY name")["name"])

    def sql(self, statement):
        """The answer to one statement that reads."""
        return _table(_rollres.sql(self.file, statement))

    def __repr__(self):
        return f"Database({self.file!r})"


def open(file):
    """The results in a database file."""
    return Database(file)


def quantities(kind="inputs"):
    """(key, type, meaning with unit, choices) of all "inputs" or "outputs"."""
    return _rollres.quantities(kind == "outputs")


def _listed(kind):
    return "\n".join(f"    {key}: {meaning}" for key, _, meaning, _ in quantities(kind))


def _number(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _shown(result):
    """Outputs of a Result that are there: key, text, meaning."""
    for key, _, meaning, _ in quantities("outputs"):
        value = getattr(result, key)
        if not (value in ("", []) or isinstance(value, float) and _math.isnan(value)):
            yield key, "; ".join(value) if isinstance(value, list) else _number(value), meaning


def _result_repr(self):
    if self.status != "converged":
        return f"<rollres.Result {self.status}: {self.reason}>"
    return (f"<rollres.Result converged: rolling_resistance = {self.rolling_resistance:.6g}, load = {self.load:.6g}, "
            f"approach = {self.approach:.6g}, error_estimate = {self.error_estimate:.2g}>")


def _result_html(self):
    rows = "".join(f"<tr><th style='text-align:left'>{key}</th><td style='text-align:left'>{_html.escape(text)}</td>"
                   f"<td style='text-align:left'>{_html.escape(meaning)}</td></tr>" for key, text, meaning in _shown(self))
    return f"<table><caption>{_html.escape(self.status)} {_html.escape(self.reason)}</caption>{rows}</table>"


def _result_dict(self):
    """Outputs by their keys."""
    return {key: getattr(self, key) for key, *_ in quantities("outputs")}


Result.__repr__ = _result_repr
Result.__str__ = lambda self: self.summary()
Result._repr_html_ = _result_html
Result.to_dict = _result_dict
Result.__doc__ = "The answer to a scene. Outputs, in SI:\n\n" + _listed("outputs")
Scene.__doc__ += _listed("inputs")
solve.__doc__ += ("\n    Inputs:\n\n" + _listed("inputs") + "\n\n    Outputs, attributes of the Result:\n\n" +
                  _listed("outputs"))
_NEEDED = dict(radius=1, layer_thickness=1, speed=1, load=1, material="elastic", static_shear_modulus=1e6)
_DEFAULTS = {key: value for key, value in Scene(_NEEDED).to_dict().items() if key not in _NEEDED}
