"""Chains of forced masses with impacts, simulated exactly from event to event."""

from __future__ import annotations

import importlib.metadata
import json
import operator
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, TypedDict

from . import _engine
from ._engine import ensemble, events, impacts, states

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

__all__ = ["Scenario", "__version__", "ensemble", "events", "impacts", "states"]
__version__ = importlib.metadata.version("impact-chain")


class _Fields(TypedDict, total=False):
    spacing: float
    natural_frequency: float
    forcing_frequency: float
    forcing_frequencies: ArrayLike
    restitution: float
    boundary: Literal["walls", "ring"]
    places: ArrayLike
    walls: ArrayLike


def _to_json(**fields: Any) -> str:
    """Writes fields as JSON, arrays of numpy included."""
    texts = []
    tolist = operator.methodcaller("tolist")
    for name, value in fields.items():
        try:
            texts.append(f'"{name}": {json.dumps(value, default=tolist, allow_nan=False)}')
        except ValueError:
            message = f"{name}: a number is not finite; give finite numbers"
            raise ValueError(message) from None
        except (AttributeError, TypeError) as error:
            message = f"{name}: {error}; give numbers or arrays of them"
            raise TypeError(message) from None
    return "{" + ", ".join(texts) + "}"


class Scenario(_engine.Scenario):
    """One chain with the amplitudes of its forcing and its start.

    Parameters
    ----------
    forcing : array_like, shape (n, 2)
        Amplitudes of cos(Ωt) and sin(Ωt) of each mass; (m, n, 2) with `forcing_frequencies`.
    initial : str or dict
        "rest", "zero" (no free part), {"free": pairs} or
        {"at": {"positions": …, "velocities": …}}.
    **fields
        The other fields of a scenario in JSON: `restitution`, `spacing`, `natural_frequency`,
        `forcing_frequency`, `boundary` ("walls" or "ring"), `places` of equilibrium, of shape
        (n,), and `walls`, the places of the left and the right one.

    Raises
    ------
    ValueError, TypeError
        A field is not allowed; the message names it and says what to write instead.
    """

    def __new__(
        cls,
        *,
        forcing: ArrayLike,
        initial: Literal["rest", "zero"] | Mapping[str, Any] = "rest",
        **fields: Unpack[_Fields],
    ) -> Scenario:
        return cls.from_json(_to_json(forcing=forcing, initial=initial, **fields))

    @classmethod
    def from_json(cls, text: str) -> Scenario:
        """Reads a scenario from JSON, as `impact-paper trace` does."""
        return super().__new__(cls, _engine.from_json(text))

    @classmethod
    def draw(
        cls,
        sigma: float,
        index: int = 0,
        *,
        masses: int = 100,
        initial: Literal["rest", "zero", "random"] = "rest",
        stream: str = "sweep",
        seed: int = 2007,
        **fields: Unpack[_Fields],
    ) -> Scenario:
        """Draws the forcing from normals, and a random start too.

        Parameters
        ----------
        sigma : float
            Standard deviation of the amplitudes.
        index, stream, seed
            Of the realisation, which has the same normals at every sigma.
        masses : int
        initial : str
            With "random" the free part is drawn like the forcing.
        **fields
            Other fields as for `Scenario`, such as `restitution` or `walls`.
        """
        for name, number in [("index", index), ("seed", seed), ("masses", masses)]:
            if not 0 <= number < 2**64:
                raise ValueError(f"{name}: {number}; give a whole number from 0 to 2**64 - 1")
        if initial not in ("rest", "zero", "random"):
            raise ValueError(f'initial: {initial!r}; give "rest", "zero" or "random"')
        is_random = initial == "random"
        text = _to_json(
            forcing=[[0, 0]] * masses, initial="zero" if is_random else initial, **fields
        )
        drawn = _engine.draw(text, sigma, index, is_random, stream, seed)
        return super().__new__(cls, drawn)

    def to_dict(self) -> dict[str, Any]:
        """Returns the fields of the scenario: `Scenario(**scenario.to_dict())` is the same."""
        fields: dict[str, Any] = json.loads(self.to_json())
        return fields

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return Scenario.from_json, (self.to_json(),)

    def __repr__(self) -> str:
        fields = self.to_dict()
        masses = len(fields["forcing"])
        return f"<Scenario: {masses} masses, r = {fields['restitution']}>"
