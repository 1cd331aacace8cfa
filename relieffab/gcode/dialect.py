"""Dialects of G-code: one table of what each controller takes, and takes differently."""

from dataclasses import dataclass, field

from relieffab.errors import InputError, suggest

COMMON = frozenset({
    *("G0", "G1", "G2", "G3", "G4", "G17", "G20", "G21", "G40", "G49", "G54", "G61", "G80"),
    *("G90", "G91", "G91.1", "G94", "M0", "M1", "M2", "M3", "M4", "M5", "M8", "M9", "M30"),
})  # fmt: skip
"""What Grbl 1.1 takes, of which programs of reliefs are made."""


@dataclass(frozen=True)
class Dialect:
    """How one controller wants its programs.

    Parameters
    ----------
    name, title : str
    characters : int
        Longest line, blanks and comments left out.
    start : tuple of str
        Lines after the one that sets units and absolute distances; `{blend}` stands for
        2 um in the program's unit.
    end : str
        The last line, by which a whole program is told from one cut short.
    takes, refuses : frozenset of str
        Codes beyond the common ones, and common ones that it does not know.
    comments : str
        '(' for those in parentheses, ';' for those to the end of the line.
    modal : bool
        Whether a motion holds until another is named.
    rapid_feed : bool
        Whether G0 goes at the feed last named, so that it needs one of its own.
    dwell : float
        What P of G4 counts to a second.
    rotary : str
        The word of a rotary axis: 'A' in degrees and feeds by inverse time (G93), 'Y' where
        one is wired in place of Y and counts mm round the face, empty where there is none.
    probe : tuple of str
        The word that moves until the probe touches, and the line that then says where that
        is; `{z}` stands for the height.
    source : str
        Where this is from.
    """

    name: str
    title: str
    characters: int
    start: tuple[str, ...]
    end: str = "M30"
    takes: frozenset[str] = field(default_factory=frozenset)
    refuses: frozenset[str] = field(default_factory=frozenset)
    comments: str = "("
    modal: bool = True
    rapid_feed: bool = False
    dwell: float = 1.0
    rotary: str = "A"
    probe: tuple[str, str] = ("G38.2", "G10 L20 P1 Z{z}")
    source: str = ""

    @property
    def codes(self) -> frozenset[str]:
        """Every G and M code a program in this dialect may hold."""
        turning = {"G93"} if self.rotary == "A" else set()
        return (COMMON | self.takes | turning) - self.refuses


_USUAL = ("G17 G94 G54",)

DIALECTS = {
    dialect.name: dialect
    for dialect in (
        Dialect(
            "grbl", "Grbl 1.1", 79, _USUAL, rotary="Y",
            source="Grbl 1.1 config.h (LINE_BUFFER_SIZE 80), gcode.c",
        ),
        Dialect(
            "grblhal", "grblHAL", 256, _USUAL, takes=frozenset({"M6"}),
            source="grblHAL core config.h, gcode.c (G93, A where N_AXIS is over 3); M6 waits for "
            "the operator",
        ),
        Dialect(
            "fluidnc", "FluidNC", 255, _USUAL,
            source="FluidNC Channel.h, GCode.cpp (G93); M6 is passed over unless set up "
            "(bdring/FluidNC#842)",
        ),
        Dialect(
            "linuxcnc", "LinuxCNC", 255, ("G17 G40 G49 G80 G91.1 G94 G54", "G64 P{blend}"),
            takes=frozenset({"M6", "G43", "G64"}),
            source="LinuxCNC interp_internal.hh (LINELEN 256), its G-code reference; "
            "without P, G64 rounds corners by any amount",
        ),
        Dialect(
            "marlin", "Marlin 2", 95, (), end="M400", comments=";", modal=False, rapid_feed=True,
            takes=frozenset({"M400"}), dwell=1000.0, rotary="", probe=("G38.2", "G92 Z{z}"),
            refuses=frozenset({
                *("G17", "G20", "G40", "G49", "G54", "G61", "G80", "G91.1", "G94"),
                *("M2", "M30"),
            }),
            source="Marlin 2 Configuration_adv.h as shipped (MAX_CMD_SIZE 96; INCH_MODE_SUPPORT, "
            "GCODE_MOTION_MODES, PAREN_COMMENTS and CNC_COORDINATE_SYSTEMS off); its M30 "
            "deletes a file",
        ),
        Dialect(
            "mach3", "Mach3", 256, ("G17 G40 G49 G80 G91.1 G94 G54 G64",),
            probe=("G31", "G92 Z{z}"),
            takes=frozenset({"M6", "G43", "G64"}),
            source="Mach3Mill manual, chapter 10; P of G4 counts seconds unless set otherwise",
        ),
    )
}  # fmt: skip
GRBL = DIALECTS["grbl"]


def dialect(name: str) -> Dialect:
    """Look a dialect up by its name.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    if name not in DIALECTS:
        raise InputError("unknown dialect of G-code", found=name, hint=suggest(name, DIALECTS))
    return DIALECTS[name]
