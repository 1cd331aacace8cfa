import math
from itertools import pairwise

import pytest

from relieffab.grbl.tracker import Tracker


@pytest.mark.parametrize("radius", [0.5, 30.0, 3000.0])
def test_chords_keep_to_the_arc_however_large_it_is(radius):
    tracker = Tracker((radius, 0.0, 0.0))
    motion = tracker.follow(f"G3X0Y{radius}I-{radius}F600")
    corners = [motion.start, *motion.points]
    middles = [[(p + q) / 2 for p, q in zip(a, b, strict=True)] for a, b in pairwise(corners)]
    assert max(radius - math.hypot(x, y) for x, y, _ in middles) < 0.011
