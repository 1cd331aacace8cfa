import pytest

from relieffab.grbl.course import Course
from relieffab.grbl.feed import Feed
from relieffab.grbl.messages import parse
from relieffab.grbl.program import prepare


def at(x, y=0.0, z=0.0, more=""):
    return parse(f"<Run|MPos:{x:.3f},{y:.3f},{z:.3f}|FS:0,0{more}>")


def on_course(text, blocks=15, offset=(0.0, 0.0, 0.0), resolution=0.0):
    course = Course(blocks, offset, resolution)
    feed = Feed(prepare(text), (0.0, 0.0, 0.0))
    lines = []
    while feed.next is not None:
        line, motion = feed.take()
        course.sent(line, motion)
        lines.append(line)
    return course, lines


def test_the_machine_is_found_within_a_line():
    course, _ = on_course("G1X10\nG0Y5\nG1X0\nM5")
    course.report(at(4))
    assert (course.cut_mm, course.reached.number, course.off_mm) == (4, 1, 0)
    course.report(at(10, 3))
    assert (course.cut_mm, course.reached.number) == (10, 2)
    course.report(at(7, 5.01))
    assert (course.cut_mm, course.reached.number) == (pytest.approx(13), 3)
    assert course.off_mm == pytest.approx(0.01)


def test_positions_are_taken_in_work_coordinates_whatever_is_reported():
    course, _ = on_course("G1X10", offset=(-100.0, -50.0, 0.0))
    course.report(at(-96, -50))
    assert course.cut_mm == 4
    course.report(at(-96, -50, 0, "|WCO:-106.000,-50.000,0.000"))
    assert course.cut_mm == 4
    course.report(at(-101, -50, 0, "|WCO:-106.000,-50.000,0.000"))
    assert course.cut_mm == 5
    status = parse("<Run|WPos:7.000,0.000,0.000|FS:0,0>")
    course.report(status)
    assert course.cut_mm == 7
    assert course.machine_position(status) == (-99, -50, 0)


def test_off_the_way_nothing_is_counted_but_the_distance():
    course, _ = on_course("G1X10\nG1X20")
    course.report(at(15, 3))
    assert (course.cut_mm, course.off_mm, course.reached.number) == (0, 3, 1)


def test_of_two_equal_places_the_earlier_is_meant():
    course, _ = on_course("G1X10\nG1X0\nG1X10")
    course.report(at(4))
    assert course.reached.number == 1


def test_what_was_acknowledged_long_ago_is_behind():
    course, lines = on_course("".join(f"G1X{i}\n" for i in range(1, 41)), blocks=5)
    for line in lines:
        course.acknowledged(line)
    assert course.reached.number == 40 - 5 - 10 + 1
    assert course.cut_mm == 25
    course.report(at(40))
    assert course.cut_mm == 40


def test_what_was_seen_counts_for_more_than_what_was_acknowledged():
    course, lines = on_course("".join(f"G1X{i}\n" for i in range(1, 41)), blocks=5)
    course.report(at(3.5))
    for line in lines:
        course.acknowledged(line)
    assert (course.reached.number, course.cut_mm) == (4, 3.5)


def test_once_astray_the_last_sightings_are_doubted():
    course, _ = on_course("".join(f"G1X{i}\n" for i in range(1, 41)))
    for x in range(1, 11):
        course.report(at(x - 0.5))
    course.report(at(12, 3))
    assert course.reached.number == 6


def test_a_line_that_was_skipped_is_where_to_go_on_however_far_the_machine_got():
    course, lines = on_course("".join(f"G1X{i}\n" for i in range(1, 41)))
    course.report(at(3.5))
    course.refused(lines[4])
    course.report(at(4.5))
    course.report(at(7.5))
    assert (course.cut_mm, course.reached) == (4.5, lines[4])


def test_lines_that_do_not_move_take_no_room_in_the_planner():
    course, lines = on_course("G1X1\n" + "S100\n" * 40, blocks=5)
    for line in lines:
        course.acknowledged(line)
    assert course.reached.number == 1


def test_moves_of_less_than_a_step_take_no_room_either():
    text = "".join(f"G1X{i}\n" + f"G1X{i}.01\n" * 9 for i in range(1, 41))
    course, lines = on_course(text, blocks=5, resolution=0.025)
    for line in lines:
        course.acknowledged(line)
    course.report(at(26.5))
    assert course.off_mm == 0
    assert course.reached.text == "G1X27"


def test_lines_that_never_move_are_not_kept_for_ever():
    course, lines = on_course("G1X0.01\n" * 5000, blocks=5)
    for line in lines:
        course.acknowledged(line)
    assert len(course._stretches) <= 2000


def test_arcs_are_followed():
    course, _ = on_course("G0X10\nG3X-10I-10F100")
    course.report(at(0, 10))
    assert course.off_mm < 0.01
    assert course.cut_mm == pytest.approx(10 * 3.14159 / 2, rel=1e-3)


def test_ways_that_are_not_known_explain_every_place_but_those_before():
    course, _ = on_course("G1X10\nG53G0Z9\nG0X0Y5\nG0Z5\nG1X5")
    course.report(at(4, 0.03))
    assert (course.reached.number, course.astray) == (1, False)
    course.report(at(10, 0, 7))
    assert (course.reached.number, course.astray) == (2, False)


def test_behind_a_way_that_is_not_known_the_machine_is_found_again():
    course, lines = on_course("G53G0Z9\nG0X0Y0\nZ5\n" + "".join(f"G1X{i}\n" for i in range(1, 41)))
    for line in lines:
        course.acknowledged(line)
    course.report(at(38, 0, 5))
    assert (course.reached.number, course.astray) == (41, False)
    course.report(at(39, 1, 5))
    assert course.astray


def test_where_the_program_cannot_be_followed_nothing_is_said():
    course, _ = on_course("G1X10")
    course.known = False
    course.report(at(5, 99))
    assert (course.off_mm, course.cut_mm) == (0, 0)


def test_the_end_is_the_last_line():
    course, lines = on_course("G1X10\nM5")
    course.finish(lines[-1])
    assert (course.cut_mm, course.reached.number) == (10, 2)
