"""The chisels: what each leaves of the stone, and how a hand moves it."""

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True)
class Chisel:
    """A chisel's marks; lengths along a stroke are in spacings.

    Parameters
    ----------
    cutter : str
        Whose tip has the cross-section of its marks, a name in machines/cutters.
    spacing : float
        Of its marks, mm.
    depth : float
        Of a mark at its deepest, mm.
    length : float
        Of a mark.
    entry, leave : float
        Over which a mark grows deep, and over which it ends.
    gap : float
        Between marks of one stroke.
    chatter : float
        Share of the depth that is lost between two blows.
    patch : float
        Width of the patches in which strokes lie side by side; 0 for one all over.
    turn : float
        How far the strokes of a patch may turn from the form's direction, degrees.
    around : bool
        Around the form instead of along it.
    tone : bool
        As deep as the light layer is dark.
    """

    cutter: str
    spacing: float
    depth: float
    length: float = inf
    entry: float = 1.0
    leave: float = 1.0
    gap: float = 0.0
    chatter: float = 0.0
    patch: float = 0.0
    turn: float = 0.0
    around: bool = False
    tone: bool = False


CHISELS = {
    # A wide edge pushed in short strokes: each ends where it breaks out.
    "flat": Chisel("ball-3.175", 1.2, 0.1, length=3.0, entry=2.2, leave=0.4),
    # Long round furrows that meet in ridges.
    "gouge": Chisel("ball-2", 1.0, 0.13, length=10.0, entry=2.5, leave=1.2, gap=0.3),
    # Deep furrows far apart, driven blow by blow.
    "point": Chisel("vee-90", 1.1, 0.3, length=9.0, entry=1.0, leave=0.5, gap=0.4, chatter=0.2),
    # Teeth side by side: furrows in patches, each from where the hand then stood.
    "claw": Chisel("tapered-ball-1", 0.8, 0.12, entry=0.8, leave=0.8, patch=9.0, turn=14.0),
    # Many short scratches, none beside the end of another.
    "rasp": Chisel(
        "tapered-ball-0.5", 0.5, 0.08, 5.0, entry=1.5, leave=1.5, gap=0.6, patch=8, turn=8
    ),
    # A burin's lines around the form, deep in its shadows.
    "hatch": Chisel("vee-90", 0.9, 0.28, around=True, tone=True),
}

# A pointed tool struck upright.
PECK = Chisel("ball-2", 1.2, 0.2)
