"""Bytes that Grbl obeys at once, wherever they arrive, and the keys that send them."""

NORMAL = b"\x90\x95\x99"
"""Feed, rapids and spindle back to what the program says."""

KEYS: dict[str, tuple[bytes, str]] = {
    "!": (b"!", "hold"),
    "~": (b"~", "go on"),
    "+": (b"\x91", "feed +10 %"),
    "-": (b"\x92", "feed -10 %"),
    "=": (b"\x90", "feed 100 %"),
    "1": (b"\x97", "rapids 25 %"),
    "2": (b"\x96", "rapids 50 %"),
    "3": (b"\x95", "rapids 100 %"),
    ">": (b"\x9a", "spindle +10 %"),
    "<": (b"\x9b", "spindle -10 %"),
    "0": (b"\x99", "spindle 100 %"),
    "s": (b"\x9e", "spindle off or on while held"),
}
"""Key -> bytes, and what they do (Grbl 1.1, doc/markdown/commands.md)."""

STOP = "x"
"""The key that stops the job: hold, then reset, so that the position is kept."""

HELP = "  ".join([*(f"{key} {does}" for key, (_, does) in KEYS.items()), f"{STOP} stop the job"])
