"""One cutter of every shape."""

import pytest

from relieffab.cutter import Cutter

COMMON = {"flute_length": 9.0, "stepdown": 1.0, "feed": 800.0, "plunge": 200.0, "rpm": 9000.0}
CUTTERS = {
    "flat": Cutter("c", "flat", 1.5, **COMMON),
    "ball": Cutter("c", "ball", 1.5, **COMMON),
    "bull": Cutter("c", "bull", 1.6, corner_radius=0.3, **COMMON),
    "vee": Cutter("c", "vee", 2.0, angle=60, tip_diameter=0.2, **COMMON),
    "sharp vee": Cutter("c", "vee", 2.0, angle=90, **COMMON),
    "tapered ball": Cutter("c", "tapered ball", 2.0, angle=20, tip_diameter=0.6, **COMMON),
    "form": Cutter("c", "form", 2.0, points=((0, 0), (0.2, 0.05), (0.6, 0.3), (1, 1.5)), **COMMON),
}


@pytest.fixture(scope="session")
def cutters():
    """All of them by their shape."""
    return CUTTERS


@pytest.fixture(scope="session", params=CUTTERS.values(), ids=CUTTERS)
def every_cutter(request):
    """Each of them in turn."""
    return request.param
