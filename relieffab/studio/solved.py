"""View and Solved: what a preview sees of a model, and the relief it comes to."""

from dataclasses import dataclass
from typing import Any

from relieffab.job import seen
from relieffab.layers.content import MESH
from relieffab.layers.make import Sight
from relieffab.layers.model import Layers
from relieffab.relief.model import Relief
from relieffab.relief.solve import Solution
from relieffab.relief.style.model import Marks
from relieffab.relief.targets import Carving


@dataclass(frozen=True, eq=False)
class View:
    """What is seen of a model.

    Parameters
    ----------
    sight : Sight or job.seen.Sight
    layers : Layers
    part : dict
        What report.json holds of it.
    carve : str
        What of it can be carved, of what was asked.
    """

    sight: Sight | seen.Sight
    layers: Layers
    part: dict[str, Any]
    carve: str

    @property
    def facts(self) -> dict[str, Any]:
        """What was found of a picture; nothing of a mesh."""
        return {} if isinstance(self.sight, Sight) else self.sight.facts

    @property
    def notes(self) -> tuple[str, ...]:
        """What a person should know of it."""
        return () if isinstance(self.sight, Sight) else self.sight.notes

    @property
    def kind(self) -> str:
        """'mesh', 'svg', or what a picture shows."""
        return self.facts.get("kind", MESH)  # type: ignore[no-any-return]


@dataclass(frozen=True, eq=False)
class Solved:
    """A relief, and what it came from.

    Parameters
    ----------
    view : View
    relief : Relief
    solution : Solution or None
        None where a classic method made it.
    carving : Carving
    marks : Marks or None
        Of a style, if the relief has them.
    """

    view: View
    relief: Relief
    solution: Solution | None
    carving: Carving
    marks: Marks | None = None
