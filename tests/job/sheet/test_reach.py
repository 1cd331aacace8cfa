from relieffab.job.sheet.reach import reach_of


def test_flutes_stay_out_of_the_collet(report):
    reach = reach_of(report["programs"][0], report["slab"])
    assert reach == (2.5, 12.0, 0.0)
    assert not reach.short


def test_depth_frame_and_nut_come_on_top_of_each_other(made):
    report = made(frame="8mm", frame_height="4mm")
    part = report["programs"][1]
    part["cutter"]["flute_length"] = 5.0
    assert reach_of(part, report["slab"]).least == 3 + 4 + 3


def test_where_work_zero_is_makes_no_difference(made):
    report = made(work_zero_z="bottom")
    part = report["programs"][1]
    part["bounds_mm"][0][2] = 12.0 - 3.0
    assert reach_of(part, report["slab"]).deep == 3.0
