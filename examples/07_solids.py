"""What becomes of one relief: framed, arched and round panels, a plaque, a mould, a frieze."""

from pathlib import Path

import numpy as np

import relieffab as rf
from relieffab.picture import panel_picture, png8, solid_picture


def scarab_relief(size: tuple[float, float], width: int, margin: float) -> rf.Relief:
    """Carve the scarab 3 mm deep into the middle of a panel."""
    mesh = rf.make_mesh(*rf.scarab(), name="scarab")
    pixels = (width, round(width * size[1] / size[0]))
    view = rf.View(up="y")
    layers = rf.make_layers(mesh, view, size=size, resolution=pixels, margin=margin)
    return rf.make_relief(layers, rf.Carving(depth=3.0))[0]


def run(folder: Path, width: int = 768) -> Path:
    """Make the solids; return the picture of them all."""
    relief = scarab_relief((120.0, 90.0), width, 18.0)
    edge = rf.Edge("fillet", 1.5)
    framed = rf.Stock(
        *(120, 90, 12),
        corner=6.0,
        frame=rf.Frame(9.0, 3.0, edge),
        holes=tuple(rf.Hole((x, y), 3.0, 5.0) for x in (4.5, 115.5) for y in (20.0, 70.0)),
    )
    round_one = rf.Stock(120, 90, 12, shape="round", frame=rf.Frame(7.0, -3.0, edge))
    tall = scarab_relief((90.0, 120.0), width * 3 // 4, 14.0)
    arched = rf.Stock(90, 120, 12, shape="arched", frame=rf.Frame(7.0, 3.0), corner=4.0)
    plain = rf.Stock(120, 90, 12)
    places = [rf.Placed(relief, at, "scarab") for at in ((0.0, 0.0), (84.0, 0.0))]
    frieze = rf.compose(places, (204.0, 90.0))
    panels = [
        (relief, framed),
        (relief, round_one),
        (tall, arched),
        (frieze, rf.Stock(204, 90, 12)),
    ]
    mould = rf.make_mould(rf.make_panel(relief, plain))
    images = [
        panel_picture(one, rf.make_panel(one, stock), width=width * 2 // 3)[0]
        for one, stock in panels
    ]
    images += [
        solid_picture(solid, relief.grid.pitch, width=width * 2 // 3)[0]
        for solid in (rf.make_plaque(relief, plain), mould)
    ]
    picture = folder / "07_solids.png"
    rows = [np.concatenate(images[k : k + 3], axis=1) for k in (0, 3)]
    picture.write_bytes(png8(np.concatenate(rows)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
