"""The names of the styles, without what it takes to carve them."""

NONE = "none"
STYLES = (NONE, "flat", "gouge", "point", "claw", "rasp", "hatch")
PLAIN, PECKED = GROUNDS = ("plain", "pecked")
