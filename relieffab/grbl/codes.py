"""What Grbl 1.1 means by the number behind `error:` and `ALARM:`.

The meanings follow Grbl's own interface documentation (doc/csv/error_codes_en_US.csv and
alarm_codes_en_US.csv of version 1.1), put in our words with what to do about them.
"""

ERRORS: dict[int, str] = {
    1: "a G-code word must begin with a letter",
    2: "a G-code word has no number, or one that cannot be read",
    3: "this $ command is not known or not supported",
    4: "a value that must not be negative is negative",
    5: "homing is switched off ($22=0)",
    6: "the step pulse must last at least 3 microseconds ($0)",
    7: "the stored settings could not be read and were set back to defaults",
    8: "this $ command works only while the machine is idle",
    9: "G-code is locked out while the machine is in alarm or jogging",
    10: "soft limits need homing switched on ($22=1)",
    11: "the line has more than 79 characters",
    12: "this setting would ask for more steps a second than the controller makes",
    13: "the safety door is open",
    14: "the build info or startup line is too long to store",
    15: "the jog would leave the machine's travel",
    16: "a jog command lacks '=' or holds a forbidden code",
    17: "laser mode needs a spindle output with PWM",
    20: "a G-code command is not supported",
    21: "two commands of the same modal group are on one line",
    22: "no feed rate (F) has been set",
    23: "a command needs a whole number",
    24: "two commands on one line both want the axis words",
    25: "the same word is on the line twice",
    26: "a command that needs axis words has none",
    27: "the line number (N) is out of range",
    28: "a command lacks the value word it needs",
    29: "only the work coordinate systems G54 to G59 exist",
    30: "G53 goes only with G0 or G1",
    31: "axis words are on a line with no command to use them",
    32: "an arc (G2, G3) has no axis word in its plane",
    33: "the target of the motion is not valid",
    34: "the radius of the arc does not reach its end point",
    35: "an arc (G2, G3) has no offset word (I, J, K) in its plane",
    36: "a value word on the line is used by no command",
    37: "the tool length offset goes only with its own axis",
    38: "the tool number is too large",
}

ALARMS: dict[int, str] = {
    1: "a limit switch was hit; the position is lost: home again",
    2: "the move would leave the machine's travel (soft limit); the position is kept",
    3: "the machine was reset while it moved; the position is lost: home again",
    4: "the probe was in the wrong state before the probing move",
    5: "the probe found nothing on its way",
    6: "homing failed: the machine was reset meanwhile",
    7: "homing failed: the safety door was opened",
    8: "homing failed: the limit switch was not released when pulling off ($27)",
    9: "homing failed: no limit switch was found on the way ($130-$132)",
    10: "homing failed: the second switch of a twin axis was not found; on grblHAL, the "
    "emergency stop is pressed",
    11: "the machine must be homed first",
    12: "a limit switch is engaged",
    13: "the probe is protected: it was triggered outside a probing move",
    14: "the spindle did not reach its speed in time",
    16: "the controller's own check of its power-on state failed",
    17: "a motor driver reports a fault",
    18: "homing failed",
    19: "the connection to the spindle was lost",
}

STATES: dict[tuple[str, int | None], str] = {
    ("Hold", 0): "held: the axes stand still, the spindle keeps turning",
    ("Hold", 1): "held: the axes are slowing down",
    ("Door", 0): "the safety door is closed again: the machine waits to be resumed",
    ("Door", 1): "the safety door is open: the spindle is off",
    ("Door", 2): "the safety door was opened: the axes are slowing down",
    ("Door", 3): "resuming after the safety door: the spindle starts",
    ("Tool", None): "the machine waits for a change of tools",
    ("Sleep", None): "the machine sleeps: only a reset wakes it",
}
"""States that a person has to know of; 11 and above of the alarms are grblHAL's."""

POSITION_LOST = frozenset({1, 3, 6, 7, 8, 9, 10, 17})
"""Alarms after which the machine does not know where it is."""


def error_meaning(code: int) -> str:
    """Say what `error:code` means.

    Examples
    --------
    >>> error_meaning(22)
    'no feed rate (F) has been set'
    >>> error_meaning(99)
    'an error Grbl 1.1 does not define (99)'
    """
    return ERRORS.get(code, f"an error Grbl 1.1 does not define ({code})")


def alarm_meaning(code: int) -> str:
    """Say what `ALARM:code` means.

    Examples
    --------
    >>> alarm_meaning(5)
    'the probe found nothing on its way'
    """
    return ALARMS.get(code, f"an alarm Grbl 1.1 does not define ({code})")
