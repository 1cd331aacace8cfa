"""The outline goes round the stock in the air; the probe says what each controller takes."""

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.gcode.aids import outline_program, probe_program
from relieffab.gcode.dialect import DIALECTS
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.machine import Machine, Material
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

TRAVEL, RATE = (200.0, 150.0, 60.0), (3000.0, 1200.0, 700.0)


def setup_of(dialect="grbl", units="mm", size=(120.0, 90.0, 12.0), zero=("near-left", "top")):
    machine = Machine("mill", "", TRAVEL, RATE, (30.0,) * 3, (0.0, 1e4), 1e4, dialect=dialect)
    return Setup(machine, Material("w", "W", 1.0, 1.0), Stock.zeroed(size, *zero), 3.0, units)


@pytest.mark.parametrize(
    ("dialect", "units"),
    [(d, u) for d in sorted(DIALECTS) for u in ("mm", "in") if (d, u) != ("marlin", "in")],
)
@pytest.mark.parametrize("zero", [("near-left", "top"), ("far", "bottom")])
def test_the_outline(dialect, units, zero):
    setup = setup_of(dialect, units, zero=zero)
    read = read_program(outline_program(setup), dialect=DIALECTS[dialect])
    points = read.on_panel(setup.stock)
    corners = [[0, 0], [120, 0], [120, 90], [0, 90], [0, 0]]
    assert np.allclose(points[-5:, :2], corners, atol=1e-3)
    assert (points[:, 2] >= 5 - 1e-6).all() and (points[:, 2] < 5.001).all()
    assert not read.spindle.any() and read.blind_line == 0
    assert read.feed[-1] <= 1200


def test_a_panel_off_the_table():
    with pytest.raises(InputError, match="does not fit on the machine's table") as error:
        outline_program(setup_of(size=(201.0, 90.0, 12.0)))
    assert "201.000 mm of X" in str(error.value)


def test_a_probe_word_for_word():
    code = [line for line in probe_program(setup_of(), 19.1).splitlines() if line[0] != "("]
    assert code == [
        "G21 G90 G17 G94 G54", "M5", "G91", "G38.2 Z-25 F100", "G0 Z2", "G38.2 Z-3 F25",
        "G10 L20 P1 Z19.1", "G0 Z10", "G90", "M30",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("dialect", "touch", "store"),
    [
        ("grblhal", "G38.2", "G10 L20 P1 Z13.5"),
        ("fluidnc", "G38.2", "G10 L20 P1 Z13.5"),
        ("linuxcnc", "G38.2", "G10 L20 P1 Z13.5"),
        ("marlin", "G38.2", "G92 Z13.5"),
        ("mach3", "G31", "G92 Z13.5"),
    ],
)
def test_probes_of_the_others_with_zero_under_the_stock(dialect, touch, store):
    text = probe_program(setup_of(dialect, zero=("centre", "bottom")), 1.5)
    assert text.count(f"\n{touch} Z-") == 2
    assert f"\n{store}\n" in text
    assert max(map(len, text.splitlines())) <= DIALECTS[dialect].characters


def test_inches():
    assert "\nG10 L20 P1 Z0.75\n" in probe_program(setup_of(units="in"), 19.05)


@pytest.mark.parametrize("plate", [-1.0, 26.0, float("nan")])
def test_plates_that_cannot_be(plate):
    with pytest.raises(InputError, match="not that thick"):
        probe_program(setup_of(), plate)


@pytest.mark.parametrize("turned", [False, True])
def test_the_outline_of_a_part(turned):
    zero = (120.0, 90.0) if turned else (60.0, 0.0)
    place = Position(2, 2, (60.0, 0.0), (120.0, 90.0), zero, turned)
    setup = setup_of().at(place)
    text = outline_program(setup)
    read = read_program(text, dialect=DIALECTS["grbl"])
    around = [[0, 0], [60, 0], [60, 90], [0, 90], [0, 0]]
    assert np.allclose(read.points[-5:, :2], around, atol=1e-3)
    assert place.placing in text
    box = read.on_panel(setup.stock)[-5:, :2]
    assert np.allclose([box.min(axis=0), box.max(axis=0)], [place.low, place.high], atol=1e-3)
