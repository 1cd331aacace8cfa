import pytest

from relieffab.grbl.simulator import SimulatedGrbl

BANNER = "Grbl 1.1h ['$' for help]"


def state(bench):
    return bench.tell(b"?")[0][1:].partition("|")[0]


def test_what_is_sent_before_the_banner_vanishes():
    machine = SimulatedGrbl(boot=1.6)
    machine.write(b"G0X1\n?")
    machine.run(3.0)
    assert [data for _, data in machine.wire.sent] == [b"\r\n", BANNER.encode() + b"\r\n"]
    assert machine.lost == 5


def test_a_blank_eeprom_prints_noise_around_the_banner(new_bench):
    said = new_bench(blank=True).said
    assert said[0] == "error:7"
    assert said[-3:] == [BANNER, ">:error:7", ">:error:7"]
    assert len(said) > 30


def test_questions_are_answered(bench):
    assert bench.tell("$I") == ["[VER:1.1h.20190825:]", "[OPT:V,15,128]", "ok"]
    assert bench.tell("$$")[-2:] == ["$132=34.000", "ok"]
    assert bench.tell("$#")[0] == "[G54:0.000,0.000,0.000]"
    assert bench.tell("$G") == ["[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]", "ok"]
    assert bench.tell("$?x") [0].startswith("<Idle")  # fmt: skip


def test_the_report_has_the_documented_fields(bench):
    first, second, third = (bench.tell(b"?")[0] for _ in range(3))
    assert first == "<Idle|MPos:0.000,0.000,0.000|Bf:15,128|FS:0,0|WCO:0.000,0.000,0.000>"
    assert second == "<Idle|MPos:0.000,0.000,0.000|Bf:15,128|FS:0,0|Ov:100,100,100>"
    assert third == "<Idle|MPos:0.000,0.000,0.000|Bf:15,128|FS:0,0>"


def test_a_fourth_axis_shows_in_every_answer_of_a_grblhal(new_bench):
    bench = new_bench(axes=4)
    assert bench.said[-1] == "GrblHAL 1.1f ['$' or '$HELP' for help]"
    told = bench.tell("$I")
    assert told[1:3] == ["[OPT:V,100,1024,4,0]", "[AXS:4:XYZA]"]
    assert {"$103=88.889", "$113=7200.000", "$123=360.000", "$133=0.000"} < set(bench.tell("$$"))
    bench.tell("G10L20P1A-90")
    told = bench.tell("$#")
    assert told[0] == "[G54:0.000,0.000,0.000,90.000]"
    assert told[-3:-1] == ["[TLO:0.000,0.000,0.000,0.000]", "[PRB:0.000,0.000,0.000,0.000:0]"]
    (report,) = bench.tell(b"?")
    assert "|MPos:0.000,0.000,0.000,0.000|Bf:100,1024|" in report
    assert report.endswith("WCO:0.000,0.000,0.000,90.000>")


def test_a_fourth_axis_keeps_its_rates_and_the_time_of_its_moves(new_bench):
    bench = new_bench(axes=4, settings={113: 600, 103: 100})
    assert bench.tell("G93G1X3A4F60", 0.5) == ["ok"]
    assert bench.machine.planner.blocks[0].feed == 5.0  # of 5 mm and degrees in a second
    assert bench.wait(4.0).machine.path == [(3.0, 0.0, 0.0, 4.0)]
    bench.tell("G0A64", 0.0)
    start = bench.machine.now
    while bench.machine.busy:
        bench.machine.step(start + 60.0)
    # 60 degrees at 10 a second, and the ramps of 360 a second squared.
    assert bench.machine.now - start == pytest.approx(6 + 10 / 360, abs=0.02)
    assert bench.tell("G94G1A0")[-1] == "error:22"
    # A turns on and on: only X, Y, Z have ends.
    bench.machine.settings.change(22, 1)
    bench.machine.settings.change(20, 1)
    assert bench.tell("G53G0X-1Y-1Z-1A720", 90.0) == ["ok"]
    assert bench.state() == "Idle"


def test_three_axes_know_no_fourth(bench):
    assert bench.tell("G0A1") == ["error:20"]
    assert bench.tell("$103=9") == ["error:3"]


def test_crlf_gives_two_acknowledgements(bench):
    assert bench.tell(b"G21\r\n") == ["ok", "ok"]


def test_comments_and_spaces_do_not_count_for_the_line_but_80_characters_do(bench):
    assert bench.tell("g0 x0 (" + "-" * 60 + ") y0 ; more", 0.5) == ["ok"]
    assert bench.tell("G0X0." + "0" * 80, 0.5) == ["error:11"]


def test_moves_are_made_and_the_path_is_kept(bench):
    assert bench.tell("G0X1\nG1Y2F600\nG1X1Y2\nM3S900", 5.0) == ["ok"] * 4
    assert bench.machine.path == [(1.0, 0.0, 0.0), (1.0, 2.0, 0.0)]
    assert bench.machine.spindle == 900
    assert bench.tell("M30") == ["[MSG:Pgm End]", "ok"]
    assert bench.machine.spindle == 0


def test_the_last_ok_comes_long_before_idle(bench):
    assert bench.tell("G1X10F60") == ["ok"]
    assert state(bench) == "Run"
    bench.wait(12)
    assert state(bench) == "Idle"


def test_time_is_true(bench):
    bench.tell("G1X20F600", 0.0)
    begin = bench.machine.now
    while not bench.machine.path:
        bench.machine.step(100.0)
    assert bench.machine.now - begin == pytest.approx(20 / 10 + 10 / 30, abs=0.01)


def test_a_dwell_reports_idle_and_holds_its_ok_back(bench):
    assert bench.tell("G4P1") == []
    assert state(bench) == "Idle"
    assert bench.wait(1.0).said[-1] == "ok"


def test_commands_while_running(bench):
    bench.tell("G1X10F100")
    for line, answer in {"$$": "error:8", "$I": "error:8", "$#": "error:8", "$1=25": "error:8",
                         "$C": "error:8", "$X": "ok"}.items():  # fmt: skip
        assert bench.tell(line) == [answer]
    assert bench.tell("$G")[-1] == "ok"


def test_hold_keeps_the_spindle_on_and_reset_then_keeps_the_position(bench):
    bench.tell("M3S500\nG1X10F600", 0.8)
    bench.tell(b"!", 0.01)
    assert state(bench) == "Hold:1"
    bench.wait(1.0)
    assert state(bench) == "Hold:0"
    assert bench.machine.spindle == 500
    place = bench.machine.planner.motion(bench.machine.now)[0]
    assert 0 < place[0] < 10
    assert bench.tell(b"\x18") == ["", BANNER]
    assert bench.machine.spindle == 0
    assert state(bench) == "Idle"
    assert bench.machine.path[-1] == pytest.approx(place, abs=0.01)


def test_hold_and_resume_reach_the_target(bench):
    bench.tell("G1X10F600", 0.5)
    bench.tell(b"!", 1.0)
    bench.tell(b"~", 2.0)
    assert bench.machine.path[-1] == (10.0, 0.0, 0.0)


def test_reset_in_motion_is_an_alarm_and_locks(bench):
    bench.tell("G1X10F600", 0.5)
    assert bench.tell(b"\x18") == ["ALARM:3", "", BANNER, "[MSG:'$H'|'$X' to unlock]"]
    assert bench.tell("G0X0") == ["error:9"]
    assert bench.tell("$X") == ["[MSG:Caution: Unlocked]", "ok"]
    assert bench.tell("G0X0")[0] == "ok"


def test_a_real_time_byte_in_a_comment_acts(bench):
    bench.tell("G1X10F600", 0.5)
    assert bench.tell("(stop!)", 1.5) == []
    assert state(bench) == "Hold:0"


def test_utf8_opens_the_door(bench):
    bench.tell("M3S100", 0.2)
    bench.tell("(\u00c4)".encode() + b"\n")
    assert state(bench) == "Door:0"
    assert bench.machine.spindle == 0


def test_m0_waits_for_cycle_start(bench):
    assert bench.tell("M3S100\nG1X1F600\nM0\nG1X2", 2.0) == ["ok", "ok"]
    assert state(bench) == "Hold:0"
    assert bench.machine.spindle == 100
    assert bench.tell(b"~", 2.0) == ["ok", "ok"]
    assert bench.machine.path[-1] == (2.0, 0.0, 0.0)


def test_soft_limit_is_an_alarm_then_silence_then_the_position_is_kept(new_bench):
    bench = new_bench(settings={22: 1, 20: 1})
    assert state(bench) == "Alarm"
    assert bench.tell("$H", 10.0) == ["ok"]
    bench.tell("G1X-10F900")
    assert bench.tell("G1X5", 6.0) == ["ALARM:2", "[MSG:Reset to continue]"]
    assert bench.tell(b"?") == []
    bench.tell(b"\x18")
    assert state(bench) == "Alarm"
    assert -10.0 <= bench.machine.path[-1][0] < -1.0


def test_the_eeprom_makes_deaf(bench):
    bench.machine.write(b"G10L2P1X1\nG4P0\n")
    bench.wait(0.01)
    bench.machine.write(b"G0X5\n")
    said = bench.wait(1.0).said
    assert bench.machine.lost > 0
    assert said.count("ok") < 3


def test_check_mode_moves_nothing_and_ends_in_a_reset(bench):
    assert bench.tell("$C") == ["[MSG:Enabled]", "ok"]
    assert bench.tell("G1X5F100") == ["ok"]
    assert bench.tell("G1X5F") == ["error:2"]
    assert BANNER in bench.tell("$C")
    assert bench.machine.path == []


def test_settings_are_kept_and_checked(bench):
    assert bench.tell("$110=900", 0.5) == ["ok"]
    assert bench.machine.settings.max_rate[0] == 15.0
    assert bench.tell("$20=1") == ["error:10"]
    assert bench.tell("$999=1") == ["error:3"]
    assert bench.tell("$110=-1") == ["error:4"]
    assert bench.tell("$H") == ["error:5"]


def test_a_startup_block_is_not_an_acknowledgement(bench):
    bench.tell("$N0=G20", 0.5)
    said = bench.tell(b"\x18")
    assert said[-1] == ">G20:ok"
    assert "G20" in bench.tell("$G")[0]


def test_a_sender_without_flow_control_overruns_the_buffer(bench):
    """As on the firmware: lines merge, acknowledgements go missing, the path goes wrong."""
    wanted = [(round(0.1 * (i % 20), 3), round(0.5 * (i // 20), 3), 0.0) for i in range(1, 400)]
    text = "".join(f"G1X{x:.3f}Y{y:.3f}F600\n" for x, y, _ in wanted)
    said = bench.tell(text.encode(), 200.0)
    assert bench.machine.lost > 1000
    assert said.count("ok") < len(wanted)
    assert bench.machine.path != wanted


def test_the_same_bytes_at_the_same_times_give_the_same_run(new_bench):
    runs = []
    for _ in range(2):
        bench = new_bench()
        said = bench.tell("G1X3Y1F500\nG1X0\nG2X2I1?", 3.0)
        runs.append((list(said), bench.machine.path, bench.machine.now))
    assert runs[0] == runs[1]
