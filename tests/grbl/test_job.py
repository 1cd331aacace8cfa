import pytest

from relieffab.grbl.controller import Controller
from relieffab.grbl.job import Job, Resume, plan
from relieffab.grbl.messages import parse
from relieffab.grbl.program import prepare
from relieffab.grbl.record import Record
from relieffab.grbl.stage import Failure, Fault

PROGRAM = prepare("G0X0Y0Z5\nG1Z-1F100\n" + "".join(f"G1X{i}F600\n" for i in range(1, 40)))
IDLE = parse("<Idle|MPos:1.000,2.000,3.000|FS:0,0>")
GC = "G0 G54 G17 G21 G90 G94 M5 M9"


def setup(found):
    return [line.text for part in found.setup for line in part.read()]


def test_a_machine_in_its_usual_state_needs_nothing_before():
    found = plan(Job(PROGRAM), Controller("1.1h", modal=GC), IDLE)
    assert (found.first, found.number, setup(found)) == (0, 1, [])
    assert found.position == (1, 2, 3)


@pytest.mark.parametrize(
    ("usual", "found"), [("G90", "G91"), ("G0", "G80"), ("G21", "G20"), ("G94", "G93")]
)
def test_what_others_left_is_put_right(usual, found):
    left = Controller("1.1h", modal=GC.replace(usual, found))
    assert setup(plan(Job(PROGRAM), left, IDLE)) == ["G0G17G21G90G94G54"]


def test_a_spindle_that_somebody_switched_on_is_not_switched_off_before_the_cut():
    left = Controller("1.1h", modal=GC.replace("M5", "M3"))
    assert setup(plan(Job(PROGRAM), left, IDLE)) == []


def test_another_system_is_left_unless_the_program_names_g54():
    left = Controller("1.1h", modal=GC.replace("G54", "G55"))
    assert setup(plan(Job(PROGRAM), left, IDLE)) == []
    named = prepare("G54\nG0X0Y0Z5")
    assert setup(plan(Job(named), left, IDLE)) == ["G0G17G21G90G94G54"]
    assert left.system == "G54"


def test_homing_comes_first():
    found = plan(Job(PROGRAM, home=True), Controller("1.1h", modal=GC), IDLE)
    assert setup(found) == ["$H"]
    found = plan(Job(PROGRAM, unlock=True, check=True), Controller("1.1h", modal=GC), IDLE)
    assert setup(found) == ["$X", "$C"]


def test_a_check_begins_with_check_mode():
    assert setup(plan(Job(PROGRAM, check=True), Controller("1.1h", modal=GC), IDLE)) == ["$C"]


def test_check_mode_is_refused_where_its_end_would_move_work_zero():
    shifted = Controller("1.1h", modal=GC, offsets={"G92": (0.0, 0.0, 2.0)})
    assert plan(Job(PROGRAM, check=True), shifted, IDLE).fault is Fault.MISFIT
    assert setup(plan(Job(PROGRAM), shifted, IDLE)) == []


@pytest.mark.parametrize(
    ("resume", "number"),
    [
        (Resume(line=20, zero_set=True), 20),
        (Resume(Record("", 9, (1, 2, 3), (0, 0, 0), True, "x")), 9),
        (Resume(Record("", 9, (1, 2, 3), (0, 0, 0), True, "x"), line=12), 12),
    ],
)
def test_where_a_job_is_taken_up(resume, number):
    found = plan(Job(PROGRAM, resume=resume), Controller("1.1h", modal=GC), IDLE)
    assert found.number == found.entry.number == number


def test_a_time_names_a_line_too():
    controller = Controller("1.1h", modal=GC)
    table = plan(Job(PROGRAM), controller, IDLE).table
    resume = Resume(seconds=table.total / 2, zero_set=True)
    found = plan(Job(PROGRAM, resume=resume), controller, IDLE)
    assert 10 < found.number < 32


def test_a_lost_zero_or_a_misfit_is_a_failure():
    found = plan(Job(PROGRAM, resume=Resume(line=9)), Controller("1.1h", modal=GC), IDLE)
    assert isinstance(found, Failure)
    assert "--zero-set" in found.hint
    assert plan(Job(PROGRAM), Controller("0.9j"), IDLE).fault is Fault.MISFIT
