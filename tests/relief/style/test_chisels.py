from relieffab.relief.style.chisels import CHISELS
from relieffab.relief.style.model import Style, mark_width
from relieffab.relief.style.names import NONE, STYLES


def test_every_name_has_a_chisel_and_its_cutter():
    assert set(STYLES) - {NONE} == set(CHISELS)
    for name in CHISELS:
        style = Style(name)
        assert style.tool.name == style.chisel.cutter
        assert style.headroom == style.chisel.depth
        # By default furrows do not run into each other deeper than their ridges are high.
        assert mark_width(style.tool, style.chisel.depth) < 1.25 * style.chisel.spacing
        style.check(3.0, 0.1)
