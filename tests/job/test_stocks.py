import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.fittings import Edge, Frame, Hole, Keyhole
from relieffab.job.settings import default_job
from relieffab.job.stocks import machine_of, stock_of
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
