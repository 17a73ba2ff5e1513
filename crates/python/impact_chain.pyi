from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict

import numpy
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

Floats = NDArray[numpy.float64]
Integers = NDArray[numpy.int64]
State = tuple[float, Sequence[float] | Floats, Sequence[float] | Floats]

__version__: str

class _Common(TypedDict, total=False):
    spacing: float
    natural_frequency: float
    forcing_frequency: float
    restitution: float
    boundary: Literal["walls", "ring"]

class _Fields(_Common, total=False):
    forcing_frequencies: ArrayLike
    places: ArrayLike
    walls: ArrayLike
    initial: Literal["rest", "zero"] | Mapping[str, Any]

class _Chain(_Common, total=False):
    masses: int
    initial: Literal["rest", "zero", "random"]

class Scenario:
    def __init__(self, *, forcing: ArrayLike, **fields: Unpack[_Fields]) -> None: ...
    @staticmethod
    def from_json(text: str) -> Scenario: ...
    @staticmethod
    def draw(
        sigma: float,
        index: int = 0,
        *,
        stream: str = "sweep",
        seed: int = 2007,
        **chain: Unpack[_Chain],
    ) -> Scenario: ...
    def to_json(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...

def impacts(
    scenario: Scenario, until: float, start: State | None = None
) -> tuple[Floats, NDArray[numpy.uint64], Floats]: ...
def events(scenario: Scenario, until: float, start: State | None = None) -> list[dict[str, Any]]: ...
def states(
    scenario: Scenario, at: float | Sequence[float] | Floats, start: State | None = None
) -> tuple[Floats, Floats]: ...
def ensemble(
    sigma: float,
    realisations: int,
    *,
    transient: float = 500.0,
    window: float = 200.0,
    stream: str = "sweep",
    seed: int = 2007,
    **chain: Unpack[_Chain],
) -> tuple[Integers, Integers]: ...
