"""Run by the system's Python: what LinuxCNC's interpreter makes of a program, as JSON.

`gcode` is LinuxCNC's own module; it calls back for every move it would make, in inches.
"""

import json
import sys


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
        return 7

    def get_external_length_units(self):
        return 1 / 25.4

    def get_external_angular_units(self):
        return 1.0

    def get_tool(self, *_):
        return (1,) + (0.0,) * 12 + (0,)

    def straight_traverse(self, x, y, z, *_):
        self.moves.append(["rapid", self.line, x, y, z])

    def straight_feed(self, x, y, z, *_):
        self.moves.append(["feed", self.line, x, y, z])

    def arc_feed(self, x, y, centre_x, centre_y, turns, z, *_):
        self.moves.append(["arc", self.line, x, y, z, centre_x, centre_y, turns])


def main(folder, program):
    import gcode

    canon = Canon(folder)
    status, line = gcode.parse(program, canon)
    fault = "" if status <= gcode.MIN_ERROR else f"line {line}: {gcode.strerror(status)}"
    json.dump({"fault": fault, "moves": canon.moves}, sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
