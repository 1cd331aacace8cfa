"""Run by the system's Python: what LinuxCNC's interpreter makes of a program, as JSON.

`gcode` is LinuxCNC's own module; it calls back for every move it would make, in inches.
"""

import ctypes
import json
import os
import sys
from pathlib import Path


class Canon:
    """Takes the interpreter's calls; those of no interest here do nothing."""

    def __init__(self, folder):
        self.parameter_file = folder + "/parameters"
        self.line = 0
        self.moves = []

    def __getattr__(self, name):
        return lambda *_: None

    def next_line(self, state):
        self.line = state.sequence_number

    def check_abort(self):
        return False

    def get_block_delete(self):
        return False

    def get_axis_mask(self):
        return 15  # X, Y, Z and A

    def get_external_length_units(self):
        return 1 / 25.4

    def get_external_angular_units(self):
        return 1.0

    def get_tool(self, *_):
        return (1,) + (0.0,) * 12 + (0,)

    def straight_traverse(self, x, y, z, a, *_):
        self.moves.append(["rapid", self.line, x, y, z, a])

    def straight_feed(self, x, y, z, a, *_):
        self.moves.append(["feed", self.line, x, y, z, a])

    def arc_feed(self, x, y, centre_x, centre_y, turns, z, *_):
        self.moves.append(["arc", self.line, x, y, z, centre_x, centre_y, turns])


def load_tools(folder):
    """Give the interpreter cutters 1 to 3, as a running LinuxCNC would."""
    table = Path(folder, "tool.tbl")
    table.write_text("".join(f"T{n} P{n} D2 Z0 ;\n" for n in (1, 2, 3)))
    os.environ["HOME"] = folder  # where it keeps the table it shares
    tools = ctypes.CDLL("libtooldata.so.0")
    tools._Z13tooldata_initb(False)
    tools._Z17tool_mmap_creatorPK13EMC_TOOL_STATi(None, 0)
    tools._Z13tooldata_loadPKcPPc(str(table).encode(), None)


def main(folder, program):
    load_tools(folder)
    import gcode

    canon = Canon(folder)
    status, line = gcode.parse(program, canon)
    fault = "" if status <= gcode.MIN_ERROR else f"line {line}: {gcode.strerror(status)}"
    json.dump({"fault": fault, "moves": canon.moves}, sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
