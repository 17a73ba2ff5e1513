from collections.abc import Sequence
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[numpy.float64]
Integers = NDArray[numpy.int64]
State = tuple[float, Sequence[float] | Floats, Sequence[float] | Floats]

class Scenario:
    def __init__(self, *, forcing: ArrayLike, **fields: Any) -> None: ...
    @staticmethod
    def from_json(text: str) -> Scenario: ...
    @staticmethod
    def draw(
        sigma: float, index: int = 0, *, stream: str = "sweep", seed: int = 2007, **chain: Any
    ) -> Scenario: ...
    def to_json(self) -> str: ...

def impacts(
    scenario: Scenario, until: float, start: State | None = None
) -> tuple[Floats, NDArray[numpy.uint64], Floats]: ...
def events(scenario: Scenario, until: float, start: State | None = None) -> list[dict[str, Any]]: ...
def states(
    scenario: Scenario, at: Sequence[float] | Floats, start: State | None = None
) -> tuple[Floats, Floats]: ...
def ensemble(
    sigma: float,
    realisations: int,
    *,
    transient: float = 500.0,
    window: float = 200.0,
    stream: str = "sweep",
    seed: int = 2007,
    **chain: Any,
) -> tuple[Integers, Integers]: ...
