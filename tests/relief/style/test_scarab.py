"""Marks on a figure of many forms: as far apart and as deep as asked, and within the bounds."""

import numpy as np
import pytest

from relieffab.layers.make import make_layers
from relieffab.layers.mesh import make_mesh
from relieffab.layers.view import View
from relieffab.relief.groove import inked
from relieffab.relief.make import make_relief
from relieffab.relief.style.make import carve_marks
from relieffab.relief.style.measure import measure
from relieffab.relief.style.model import Style
from relieffab.relief.targets import Carving
from relieffab.subject import scarab

DEPTH = 2.4
STYLES = ("flat", "gouge", "point", "claw", "rasp", "hatch")


@pytest.fixture(scope="module")
def carved():
    """The scarab, and its relief before the marks."""
    mesh = make_mesh(*scarab(), name="scarab", usual_up="y")
    size, pixels = (72.0, 54.0), (640, 480)
    layers = make_layers(mesh, View(up="y"), size=size, resolution=pixels, margin=2.0)
    return layers, make_relief(layers, Carving(depth=DEPTH - 0.3))[0]


@pytest.mark.parametrize("name", STYLES)
def test_marks_are_as_far_apart_and_as_deep_as_asked(carved, name):
    layers, smooth = carved
    style = Style(name)
    relief, marks = carve_marks(smooth, layers, style, depth=DEPTH)
    assert (relief.heights >= -DEPTH).all() and (relief.heights <= smooth.heights).all()
    found = measure(relief, marks, style)["figure"]
    assert found.spacing == pytest.approx(style.chisel.spacing, rel=0.1)
    assert found.depth == pytest.approx(style.chisel.depth, rel=0.1)
    assert found.within > 0.99
    grooves = inked(layers, 1.0) < -0.5
    assert np.mean((smooth.heights - relief.heights)[grooves] > 0.02) < 0.02
