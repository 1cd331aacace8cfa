from dataclasses import asdict
from math import cos, sin

import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.fittings import Edge, Frame, Hole, Keyhole
from relieffab.job import milling, solids
from relieffab.job.settings import default_job
from relieffab.job.stocks import machine_of, milled_of, round_of, stock_of
from relieffab.round import Curved, Round
from relieffab.stock import Stock


def test_by_default_it_is_a_plain_slab():
    assert stock_of(default_job(size="4x3cm", thickness="1cm")) == Stock(40.0, 30.0, 10.0)


def test_settings_as_they_are_typed_make_a_stock():
    job = default_job(
        outline="arched", corner="3mm", frame="10mm", frame_height="-2mm",
        frame_edge="chamfer 0.5mm", holes="5x5mm, 115x5mm", hole="3mm", countersink="6mm",
        keyholes="6x6cm", thickness="15mm",
    )  # fmt: skip
    assert stock_of(job) == Stock(
        *(120.0, 90.0, 15.0),
        shape="arched",
        corner=3.0,
        frame=Frame(10.0, -2.0, Edge("chamfer", 0.5)),
        holes=(Hole((5.0, 5.0), 3.0, 6.0), Hole((115.0, 5.0), 3.0, 6.0)),
        keyholes=(Keyhole((60.0, 60.0)),),
    )


def test_over_a_raised_frame_the_machine_keeps_higher():
    plain = profiles.machine("3018-prover").safe_height
    assert machine_of(default_job()).safe_height == plain
    assert machine_of(default_job(frame="8mm", frame_height="3mm")).safe_height == plain + 3
    assert machine_of(default_job(frame="8mm", frame_height="-3mm")).safe_height == plain


@pytest.mark.parametrize(
    ("given", "word"),
    [
        ({"frame_edge": "fillet 1mm"}, "no frame"),
        ({"countersink": "8mm"}, "no holes"),
        ({"frame": "8mm", "frame_edge": "chamfer"}, "break an edge"),
        ({"frame": "8mm", "frame_edge": "bevel 1mm"}, "break an edge"),
        ({"holes": "10mm"}, "no place on the panel"),
        ({"holes": "10x10mm; 20x20mm"}, "no place|not a size"),
        ({"holes": "-10x10mm"}, "no place on the panel"),
        ({"outline": "oval"}, "rectangle or round or arched"),
    ],
)
def test_what_makes_no_sense_is_refused(given, word):
    with pytest.raises(InputError, match=word):
        stock_of(default_job(**given))


def test_a_round_stock_is_laid_out_flat_and_lies_along_x():
    job = default_job(round="80mm", bore="60mm", size="120x90mm", machine="altmill-4x4-rotary")
    assert round_of(job) == Round(120.0, 90.0, 80.0, 60.0)
    assert stock_of(job) == Stock(120.0, 90.0, 10.0)
    assert milled_of(job) == Stock(90.0, 120.0, 10.0, radius=40.0)
    assert machine_of(job).travel[1] > 80 * 3.14
    axis = default_job(round="80mm", work_zero_z="bottom")
    assert milled_of(axis).work_zero == (0.0, 0.0, -40.0)


def test_a_curved_board_lies_on_its_back():
    job = default_job(curved="300mm")
    assert round_of(job) == Curved(120.0, 90.0, 12.0, 300.0)
    board = milled_of(job)
    assert (board.width, board.height, board.thickness) == (
        pytest.approx(600 * sin(0.2)), 90.0, 12.0,
    )  # fmt: skip
    assert board.face([0.0, board.width / 2]) == pytest.approx([300 * cos(0.2) - 300, 0.0])
    assert board.lowest(3.0) == pytest.approx(3 + 300 * (1 - cos(0.2)))
    assert Stock.of(asdict(board)) == board


@pytest.mark.parametrize(
    ("given", "word"),
    [
        ({"bore": "60mm"}, "no round"),
        ({"round": "80mm", "floor": "5mm"}, "no bore"),
        ({"round": "80mm", "curved": "300mm"}, "not both"),
        ({"round": "80mm", "frame": "8mm"}, "only a flat panel can have frame"),
        ({"round": "80mm", "outline": "round"}, "only a flat panel can have outline"),
        ({"curved": "300mm", "holes": "5x5mm"}, "only a flat panel can have holes"),
        ({"round": "30mm"}, "wider than the way round"),
    ],
)
def test_round_stocks_that_cannot_be(given, word):
    with pytest.raises(InputError, match=word):
        round_of(default_job(**given))


@pytest.mark.parametrize(
    ("given", "word"),
    [
        ({"solid": "plaque"}, "only a flat panel has a plaque"),
        ({"bed": "50x50mm"}, "only a flat panel comes in parts"),
        ({"bore": "75mm"}, "through the stock"),
    ],
)
def test_solids_that_a_round_stock_has_not(given, word):
    with pytest.raises(InputError, match=word):
        solids.check(default_job(round="80mm", **given))


@pytest.mark.parametrize(
    ("given", "word"),
    [
        ({"machine": "3018-prover"}, "no rotary axis"),
        ({"machine": "3018-prover-rotary"}, "too thick"),
        ({"machine": "altmill-4x4-rotary", "positions": "index"}, "several positions"),
        ({"machine": "altmill-4x4-rotary", "bore": "20mm", "depth": "28mm"}, "too short"),
    ],
)
def test_programs_that_cannot_be_are_refused_before_any_work(given, word):
    with pytest.raises(InputError, match=word):
        milling.check(default_job(round="80mm", **given))
