"""All measures of a relief together."""

from dataclasses import asdict, dataclass
from math import isnan

from relieffab.cutter import Cutter
from relieffab.layers.model import Layers
from relieffab.relief.model import Relief
from relieffab.relief.quality.angle import Angle, angle
from relieffab.relief.quality.border import Border, border
from relieffab.relief.quality.carve import Carve, carve
from relieffab.relief.quality.detail import Detail, detail
from relieffab.relief.quality.drawn import drawn
from relieffab.relief.quality.order import Order, order
from relieffab.relief.quality.pair import Pair
from relieffab.relief.quality.relit import Relit, relit
from relieffab.relief.quality.use import Use, use
from relieffab.relief.quality.visibility import Visibility, visibility


@dataclass(frozen=True)
class Quality:
    """A relief in figures; NaN where one has no meaning, such as without lines.

    Parameters
    ----------
    relit : Relit
    angle : Angle
    order : Order
    visibility : Visibility
    use : Use
    detail : Detail
    carve : Carve
    border : Border
    """

    relit: Relit
    angle: Angle
    order: Order
    visibility: Visibility
    use: Use
    detail: Detail
    carve: Carve
    border: Border

    def as_dict(self) -> dict[str, dict[str, float | None]]:
        """Return plain numbers by measure and figure, None for NaN."""
        return {
            measure: {name: None if isnan(value) else float(value) for name, value in part.items()}
            for measure, part in asdict(self).items()
        }


def measure(relief: Relief, layers: Layers, cutter: Cutter) -> Quality:
    """Measure a relief against the layers it was made from.

    Parameters
    ----------
    relief : Relief
    layers : Layers
        On the same grid.
    cutter : Cutter
        The finest that carves it.

    Returns
    -------
    Quality

    Raises
    ------
    InputError
        If the relief and the layers are not on the same pixels.
    """
    pair = Pair(relief, layers)
    lines = drawn(pair)
    return Quality(
        relit=relit(pair),
        angle=angle(pair),
        order=order(pair),
        visibility=visibility(pair, lines),
        use=use(pair),
        detail=detail(pair),
        carve=carve(pair, cutter, lines),
        border=border(pair),
    )
