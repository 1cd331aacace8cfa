import pytest

from relieffab.grbl.course import Course
from relieffab.grbl.feed import Feed
from relieffab.grbl.messages import parse
from relieffab.grbl.program import prepare
from relieffab.grbl.stage import Fault, Patience
from relieffab.grbl.watch import Watch
from relieffab.grbl.window import Window


class Bench:
    """A watch with lines on their way."""

    def __init__(self, text, **options):
        self.course, self.window = Course(15, (0.0, 0.0, 0.0)), Window(128)
        self.watch = Watch(self.course, self.window, Patience(), **{"attended": False} | options)
        feed = Feed(prepare(text), (0.0, 0.0, 0.0))
        while feed.next is not None:
            line, motion = feed.take()
            self.course.sent(line, motion)
            self.window.sent(line)
            self.watch.sent(3.0 if b"G4" in line.wire else 0.0)

    def report(self, text, now=0.0):
        status = parse(f"<{text}|FS:0,0>")
        self.course.report(status)
        return self.watch.report(status, now)


def test_bytes_that_are_nowhere_were_lost():
    bench = Bench("G1X10\nG1X11\nG1X12")
    bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,112")
    for free in (122, 116):  # one report may be damaged itself
        bench.watch.asked()
        assert bench.report(f"Run|MPos:0.000,0.000,0.000|Bf:15,{free}") is None
    bench.watch.asked()
    failure = bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,122")
    assert failure.fault is Fault.LOST_ACKNOWLEDGEMENT
    assert failure.found.startswith("6 bytes")


def test_a_controller_that_never_counts_its_bytes_is_not_held_to_them():
    bench = Bench("G1X10\nG1X11\nG1X12")
    for _ in range(9):
        bench.watch.asked()
        assert bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,128") is None


def test_bytes_in_the_controllers_buffer_are_not_lost():
    bench = Bench("G1X10\nG1X11\nG1X12")
    for _ in range(9):
        bench.watch.asked()
        assert bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,116") is None


def test_more_in_the_buffer_than_was_sent_is_somebody_elses():
    bench = Bench("G1X10\nG1X11\nG1X12")
    assert bench.report("Hold:0|MPos:0.000,0.000,0.000|Bf:15,110") is None
    assert bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,109") is None
    assert bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,110") is None
    failure = bench.report("Run|MPos:0.000,0.000,0.000|Bf:15,109")
    assert failure.fault is Fault.STRAY_ACKNOWLEDGEMENT


def test_one_report_off_the_way_may_be_damaged_two_are_not():
    bench = Bench("G1X10\nG1X11")
    assert bench.report("Run|MPos:5.000,3.000,0.000") is None
    assert bench.report("Run|MPos:5.000,0.000,0.000") is None
    assert bench.report("Run|MPos:5.500,3.000,0.000").fault is Fault.OFF_COURSE


def test_damaged_reports_tell_that_commands_may_be_damaged_too():
    watch = Bench("G0X1").watch
    assert [watch.noise("<Ru") and "noisy" for _ in range(2)] == [None, None]
    assert watch.noise("<Ru").fault is Fault.GARBLED


def test_an_ok_that_never_comes_times_out_only_while_the_machine_is_idle():
    bench = Bench("G0X1\nG0X2")
    for second in range(60):
        assert bench.report("Run|MPos:1.000,0.000,0.000", second) is None
    for second in range(60, 67):
        assert bench.report("Idle|MPos:1.000,0.000,0.000", second) is None
    failure = bench.report("Idle|MPos:1.000,0.000,0.000", 67)
    assert failure.fault is Fault.LOST_ACKNOWLEDGEMENT
    assert failure.found.endswith("2")


def test_a_dwell_may_be_idle_for_its_own_time():
    bench = Bench("G4P3")
    for second in range(10):
        assert bench.report("Idle|MPos:0.000,0.000,0.000", second) is None
    assert bench.report("Idle|MPos:0.000,0.000,0.000", 10) is not None


@pytest.mark.parametrize("state", ["Hold:0", "Door:1", "Door:0"])
def test_a_hold_nobody_can_end_ends_the_job_by_name(state):
    bench = Bench("G0X1")
    for second in range(61):
        assert bench.report(f"{state}|MPos:0.000,0.000,0.000", second) is None
    failure = bench.report(f"{state}|MPos:0.000,0.000,0.000", 61)
    assert failure.fault is Fault.HELD
    assert ("door" in failure.found) is state.startswith("Door")


def test_a_person_may_take_all_day():
    bench = Bench("G0X1", attended=True)
    for second in range(0, 90_000, 1000):
        assert bench.report("Hold:0|MPos:0.000,0.000,0.000", second) is None
