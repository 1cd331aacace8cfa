"""Reliefs on round stocks, from planning to the judgement of the text."""

import re
from dataclasses import replace

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.aids import outline_program
from relieffab.gcode.dialect import DIALECTS
from relieffab.gcode.ease import eased
from relieffab.gcode.estimate import estimate
from relieffab.gcode.post import Post
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import verify
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material, Rotary, turning
from relieffab.relief.laid import laid
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath.plan import plan

RADIUS = 10.0
COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 900.0, "plunge": 300.0, "rpm": 8000.0}
CUTTERS = (
    Cutter("mill", "flat", 3.0, **COMMON),
    Cutter("ball", "ball", 1.0, **COMMON),
    Cutter("fine", "tapered ball", 2.0, tip_diameter=0.5, angle=15.0, **COMMON),
)
WOOD = Material("wood", "Wood", 1.0, 1.0)


def bump():
    """A smooth figure up to 1.5 mm deep, 20 mm of the 62.8 mm round the face."""
    y, x = np.mgrid[0:49, 0:81] * 0.25
    d = np.hypot((x - 10) / 8, (y - 6) / 4.5)
    h = -1.5 * np.clip(1.4 - 1.4 * d**2, 0, 1) * (0.8 + 0.2 * np.cos(2 * x))
    mask = (h[1:, 1:] < 0) | (h[:-1, :-1] < 0) | (h[1:, :-1] < 0) | (h[:-1, 1:] < 0)
    return Relief(Grid(48, 80, 0.25, (0.0, 12.0)), h, mask, 1.5)


def setup_of(dialect):
    machine = Machine(
        "mill", "", (200.0, 160.0, 40.0), (1500.0,) * 3, (100.0,) * 3, (0.0, 1e4), 1e4,
        dialect=dialect, rotary=Rotary(3600.0, 360.0, 60.0),
    )  # fmt: skip
    stock = Stock(12.0, 20.0, RADIUS, radius=RADIUS)
    return Setup(turning(machine, RADIUS), WOOD, stock, 1.5)


@pytest.fixture(scope="module")
def paths():
    setup = setup_of("grblhal")
    milled = laid(bump(), setup.stock)
    return plan(milled, [], setup.machine, WOOD, cutters=CUTTERS, stock=setup.stock)


def written(paths, setup):
    slab = Slab.whole(laid(bump(), setup.stock).grid, setup.stock)
    return [write_program(path, setup, slab) for path in paths]


def judged(texts, paths, setup):
    milled = laid(bump(), setup.stock)
    return verify(texts, [path.cutter for path in paths], milled, setup, refine=2)


@pytest.mark.parametrize("dialect", ["grblhal", "grbl"])
def test_a_relief_on_a_column_is_carved(paths, dialect):
    setup = setup_of(dialect)
    texts = written(paths, setup)
    verdict = judged(texts, paths, setup)
    assert verdict.ok, verdict.findings
    assert verdict.gouge_mm <= 0.005
    assert verdict.within_tolerance > 0.97
    word = "A" if dialect == "grblhal" else "Y"
    for text in texts:
        assert ("\nG93\n" in text) == (word == "A")
        assert re.search(rf"\n[^(\n]*{word}[-\d.]+", text)
        assert not re.search(rf"\n[^(\n]*{'Y' if word == 'A' else 'A'}[-\d.]+", text)


def test_angle_and_length_say_the_same(paths):
    one, other = setup_of("grblhal"), setup_of("grbl")
    a, y = (
        read_program(written(paths, s)[1], dialect=s.post.dialect, radius=RADIUS)
        for s in (one, other)
    )
    ends_a, ends_y = a.points[a.rapid], y.points[y.rapid]
    np.testing.assert_allclose(ends_a, ends_y, atol=0.0015)
    assert (a.feed[~a.rapid] <= 900.0 * (1 + 1e-9)).all()
    assert estimate(a, one.machine) == pytest.approx(estimate(y, other.machine), rel=0.05)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: re.sub(r"\nG93\n", "\nG93\nG91\nG0A2\nG90\n", text), None),
        (lambda text: re.sub(r"Z-", "Z-0", text), None),
        (
            lambda text: re.sub(r"A([\d.]+)", lambda m: f"A{float(m[1]) + 1.5:.4f}", text),
            "gouges",
        ),
        (
            lambda text: re.sub(r"Z-([\d.]+)", lambda m: f"Z-{float(m[1]) + 0.03:.3f}", text),
            "gouges",
        ),
    ],
)
def test_a_changed_program_is_found_out(paths, change, words):
    setup = setup_of("grblhal")
    texts = written(paths, setup)
    texts[1] = change(texts[1])
    if words is None and "G91" in texts[1]:
        with pytest.raises(InputError, match="place not known"):
            judged(texts, paths, setup)
        return
    verdict = judged(texts, paths, setup)
    found = " ".join(verdict.findings)
    assert verdict.ok if words is None else words in found


def test_a_band_all_round_is_cut_across_its_seam():
    radius, count, rows = 8.0, 144, 36
    pitch = 2 * np.pi * radius / count
    v, u = np.arange(rows + 1) * pitch, np.arange(count + 1) * pitch
    side = np.clip(np.minimum(v, v[-1] - v) - 2.0, 0, 1)[:, None]
    heights = -1.2 * side * (0.75 + 0.25 * np.cos(5 * u / radius + 1.0))
    mask = np.broadcast_to(np.abs(v[:-1] - v[-1] / 2)[:, None] < v[-1] / 2 - 1.5, (rows, count))
    band = Relief(Grid(rows, count, pitch, (0.0, rows * pitch)), heights, mask.copy(), 1.2)
    stock = Stock(rows * pitch, 2 * np.pi * radius, radius, radius=radius)
    setup = replace(setup_of("grblhal"), stock=stock)
    setup = replace(setup, machine=turning(setup.machine, radius), depth=1.2)
    milled = laid(band, stock)
    found = plan(milled, [], setup.machine, WOOD, cutters=CUTTERS, stock=stock)
    slab = Slab.whole(milled.grid, stock)
    texts = [write_program(eased(path, setup, slab), setup, slab) for path in found]
    verdict = verify(texts, [path.cutter for path in found], milled, setup, refine=1)
    assert verdict.ok, verdict.findings
    seam = np.abs(np.where(verdict.figure, verdict.deviation, 0.0))[[0, 1, 2, -3, -2, -1]]
    assert 0 < seam.max() < 0.08


def test_what_the_flat_picture_allows_gouges_a_thin_column():
    # Slopes of 1.5 mm on a column of 10 mm: planned flat, the cutter's side meets them.
    y, x = np.mgrid[0:49, 0:81] * 0.25
    inside = np.minimum.reduce([x - 5, 15 - x, y - 3, 9 - y])
    heights = -1.5 * np.clip(inside, 0, 1)
    pit = Relief(Grid(48, 80, 0.25, (0.0, 12.0)), heights, np.ones((48, 80), bool), 1.5)
    setup = replace(setup_of("grblhal"), stock=Stock(12.0, 20.0, 5.0, radius=5.0))
    milled = laid(pit, setup.stock)
    deepest = []
    for stock in (setup.stock, replace(setup.stock, radius=0.0)):
        found = plan(milled, [], setup.machine, WOOD, cutters=CUTTERS, stock=stock)
        slab = Slab.over(milled.grid, setup.stock)
        for path in found:
            slab.cut(path.points, path.cutter)
        deepest.append(float((slab.heights - milled.heights).min()))
    right, wrong = deepest
    assert right > -0.005
    assert wrong < -0.05


def test_the_outline_turns_the_work_in_the_air():
    setup = setup_of("fluidnc")
    read = read_program(outline_program(setup), dialect=setup.post.dialect, radius=RADIUS)
    np.testing.assert_allclose(np.ptp(read.points, axis=0), [12, 20, 0], atol=1e-3)
    assert read.feed[~read.rapid].max() <= 1500 * (1 + 1e-9)


def test_a_controller_without_a_rotary_axis_is_refused():
    with pytest.raises(InputError, match="no rotary axis and no inverse time"):
        Post(DIALECTS["marlin"], radius=RADIUS)


@pytest.mark.parametrize(
    ("rate", "length", "text"),
    [(600, 0.05, "12000"), (600, 7, "85.714"), (100, 3000, "0.033333"), (333.3, 0.001, "333300")],
)
def test_inverse_time_is_never_faster(rate, length, text):
    assert Post(DIALECTS["grblhal"], radius=RADIUS).inverse(rate, length) == text
    assert float(text) * length <= rate * (1 + 1e-12)
