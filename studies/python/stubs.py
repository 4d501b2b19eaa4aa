"""Writes the type stubs of the package, of the lists of quantities that the package itself tells: stubs.py FILE."""

import ast
import sys

import rollres

HEAD = '''"""Written by studies/python/stubs.py."""
from os import PathLike
from typing import Any, Callable, Iterable, Literal, Mapping, Sequence, TypedDict, Unpack
import numpy
import numpy.typing

__version__: str
_File = str | PathLike[str]
_Number = float | str
'''

TAIL = '''
_Base = _File | Scene | Mapping[str, Any] | None

def solve(base: _Base = None, /, **inputs: Unpack[_Inputs]) -> Result: ...
def model(base: _Base = None, /, **inputs: Unpack[_Inputs]) -> Report: ...
def solve_many(scenes: Iterable[Any], base: _Base = None, *, threads: int = 0,
               progress: Callable[[int, int], object] | None = None, fields: bool = False,
               db: _File | None = None, map: Callable[..., Iterable[Any]] | None = None) -> list[Result]: ...
class Report(dict[str, Any]):
    def __getattr__(self, name: str) -> Any: ...
def gradient(base: _Base, inputs: Sequence[str], output: str = "rolling_resistance", *, order: int = 4,
             threads: int = 0, **replaced: Unpack[_Inputs]) -> Report: ...
class _Scaled:
    names: list[str]
    x0: list[float]
    bounds: list[tuple[float | None, float | None]]
    def of(self, x: Iterable[float]) -> list[float]: ...
    def values(self, scaled: Iterable[float]) -> list[float]: ...
    def __call__(self, scaled: Iterable[float]) -> float: ...
    def gradient(self, scaled: Iterable[float]) -> numpy.typing.NDArray[numpy.float64]: ...
class Objective:
    names: list[str]
    bounds: list[tuple[float, float]]
    x0: list[float]
    scales: list[float]
    scaled: _Scaled
    def __call__(self, x: Iterable[float]) -> float: ...
    def gradient(self, x: Iterable[float]) -> numpy.typing.NDArray[numpy.float64]: ...
    def value_and_gradient(self, x: Iterable[float]) -> tuple[float, list[float], list[float]]: ...
    def scene(self, x: Iterable[float]) -> Scene: ...
    def solve_many(self, points: Iterable[Iterable[float]], **options: Any) -> list[Result]: ...
def objective(base: _Base, inputs: Sequence[str] | Mapping[str, tuple[float | str | None, float | str | None] | None],
              output: str = "rolling_resistance", *, threads: int = 0, order: int = 4,
              **replaced: Unpack[_Inputs]) -> Objective: ...
def sweep(study: _File | Mapping[str, Any], db: _File, *, threads: int = 0,
          progress: Callable[[int, int], object] | None = None, fields: bool = False,
          retry: Literal["nothing", "failed", "not_converged", "all"] = "nothing") -> Report: ...
def fit(fit: _File | Mapping[str, Any], db: _File | None = None, *, data: Any = None, threads: int = 0,
        profiles: bool = True) -> Report: ...
def predict(fit: _File | Mapping[str, Any], scenes: Any, db: _File | None = None, *,
            predict_as: Literal["true_value", "reading", "measurement"] = "true_value", data_set: str | None = None,
            data: Any = None, threads: int = 0) -> Any: ...
def command(*words: _File) -> str: ...
class Database:
    file: str
    def __init__(self, file: _File) -> None: ...
    def query(self, *filters: str, columns: Sequence[str] = (), sort: Sequence[str] = (),
              limit: int | None = None) -> Any: ...
    def study(self, name: str, *filters: str, **options: Any) -> Any: ...
    def studies(self) -> list[str]: ...
    def sql(self, statement: str) -> Any: ...
def open(file: _File) -> Database: ...
def quantities(kind: Literal["inputs", "outputs"] = "inputs") -> list[tuple[str, str, str, list[str]]]: ...
'''


def choice(kind, choices):
    return "Literal[" + ", ".join(map(repr, choices)) + "]" if choices else kind


def given(kind, choices):
    """What an input takes; numbers may have a unit."""
    if choices:
        return choice(kind, choices)
    return {"float": "_Number", "float | None": "_Number", "list[float]": "Sequence[_Number]",
            "list[dict]": "Sequence[Mapping[str, Any]]"}.get(kind, kind)


def members(kind):
    for key, of_type, meaning, choices in rollres.quantities(kind):
        yield f"    @property\n    def {key}(self) -> {choice(of_type, choices)}:\n        {meaning!r}\n"


def stubs():
    inputs = "".join(f"    {key}: {given(kind, choices)}\n" for key, kind, _, choices in rollres.quantities("inputs"))
    fields = "".join(f"    @property\n    def {name}(self) -> numpy.ndarray | None:\n        {value.__doc__!r}\n"
                     for name, value in vars(rollres.Fields).items() if isinstance(value, property))
    return (HEAD + "\nclass _Inputs(TypedDict, total=False):\n    diameter: _Number\n" + inputs +
            "\nclass Scene:\n    def __init__(self, base: Any = None, /, **inputs: Unpack[_Inputs]) -> None: ...\n"
            "    def replace(self, **inputs: Unpack[_Inputs]) -> Scene: ...\n"
            "    def replaced(self, inputs: Mapping[str, Any]) -> Scene: ...\n"
            "    def to_dict(self) -> dict[str, Any]: ...\n    def json(self) -> str: ...\n"
            "    @property\n    def diameter(self) -> float: ...\n" + "".join(members("inputs")) +
            "\nclass Fields:\n" + fields +
            "\nclass Result:\n    @property\n    def scene(self) -> Scene: ...\n"
            "    @property\n    def fields(self) -> Fields | None: ...\n    def summary(self) -> str: ...\n"
            "    def json(self) -> str: ...\n    def to_dict(self) -> dict[str, Any]: ...\n" +
            "".join(members("outputs")) + TAIL)


text = stubs()
ast.parse(text)
with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write(text)
