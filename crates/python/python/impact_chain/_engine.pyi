from collections.abc import Sequence
from typing import Literal, TypedDict

import numpy
from numpy.typing import NDArray
from typing_extensions import Self

Floats = NDArray[numpy.float64]
Integers = NDArray[numpy.int64]
State = tuple[float, Sequence[float] | Floats, Sequence[float] | Floats]

class Event(TypedDict):
    kind: Literal["impact", "stick", "release", "graze"]
    time: float
    gaps: list[int]
    closing_speed: float | None

class Scenario:
    def __new__(cls, scenario: Scenario) -> Self: ...
    def to_json(self) -> str: ...

def from_json(text: str) -> Scenario: ...
def draw(
    text: str, sigma: float, index: int, is_random_start: bool, stream: str, seed: int
) -> Scenario: ...
def impacts(
    scenario: Scenario, until: float, start: State | None = None
) -> tuple[Floats, NDArray[numpy.uint64], Floats]: ...
def events(scenario: Scenario, until: float, start: State | None = None) -> list[Event]: ...
def states(
    scenario: Scenario, at: float | Sequence[float] | Floats, start: State | None = None
) -> tuple[Floats, Floats]: ...
def ensemble(
    scenarios: Sequence[Scenario], until: float, *, transient: float = 0.0
) -> tuple[Integers, Integers]: ...
