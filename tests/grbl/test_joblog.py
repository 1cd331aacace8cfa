import io

import pytest

from relieffab.errors import InputError, MachineError
from relieffab.grbl.job import Job
from relieffab.grbl.joblog import Log, replay
from relieffab.grbl.port import open_port
from relieffab.grbl.program import prepare
from relieffab.grbl.sender import Company, send

PROGRAM = "M3S1000\nG0Z5\n" + "".join(f"G1X{i * 0.3:.1f}Y{i % 7}F900\n" for i in range(80)) + "M5"
FAST = "sim://?speed=max&boot=0.1"


def logged(url=FAST, text=PROGRAM, typed=None):
    stream = io.StringIO()
    company = Company(log=lambda digest, now: Log(stream, digest, now), typed=typed)
    with open_port(url) as port:
        try:
            send(text, port, company)
            error = None
        except MachineError as caught:
            error = caught
    return stream.getvalue().splitlines(), error


def test_a_job_can_be_lived_through_again():
    lines, error = logged()
    session = replay(lines, Job(prepare(PROGRAM)))
    assert error is None
    assert session.over
    assert session.failure is None
    assert session.acknowledged == 83


@pytest.mark.parametrize(
    "fault", ["&reboot_at=4", "&flip=1e-3&seed=5", "&limit_at=3", "&mute_at=3", "&unplug_at=3"]
)
def test_a_failure_can_be_lived_through_again(fault):
    lines, error = logged(FAST + fault)
    session = replay(lines, Job(prepare(PROGRAM)))
    assert session.over
    assert error is not None
    assert session.failure.message in str(error)


def test_keys_are_part_of_the_log():
    keys = iter([""] * 60 + ["+"] + [""] * 60 + ["x"])
    lines, _ = logged(typed=lambda: next(keys, ""))
    assert any(line.endswith("key \\x91") for line in lines)
    session = replay(lines, Job(prepare(PROGRAM), attended=True))
    assert "cancelled" in session.failure.message


def test_another_program_or_another_course_is_noticed():
    lines, _ = logged()
    with pytest.raises(InputError, match="another program"):
        replay(lines, Job(prepare("G0X1")))
    at = next(i for i, line in enumerate(lines) if "> G0Z5" in line or "G0Z5" in line)
    changed = [*lines[:at], lines[at].replace("G0Z5", "G0Z6"), *lines[at + 1 :]]
    with pytest.raises(InputError, match="differs"):
        replay(changed, Job(prepare(PROGRAM)))


def test_what_is_no_log():
    for lines in ([], ["# nothing"], ["0.0 < ok"]):
        with pytest.raises(InputError, match="no log"):
            replay(lines, Job(prepare("G0X1")))
