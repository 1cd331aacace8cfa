from relieffab.layers.lines import contours, highlights, ridges
from relieffab.layers.lines.kinds import KINDS


def test_every_kind_has_its_own_finder():
    table = {kind.name: (kind.principal, kind.of_surface) for kind in KINDS}
    assert table == {
        "outline": (True, None),
        "contour": (True, contours.contours),
        "boundary": (True, None),
        "crease": (True, None),
        "suggestive": (False, contours.suggestive),
        "ridge": (False, ridges.ridges),
        "valley": (False, ridges.valleys),
        "apparent-ridge": (False, ridges.apparent_ridges),
        "suggestive-highlight": (False, highlights.suggestive_highlights),
        "principal-highlight": (False, highlights.principal_highlights),
    }
