from relieffab.job.sheet import tools


def test_a_cutter_is_listed_once_with_all_its_programs(report):
    again = {**report["programs"][0], "file": "2-01-rough.nc"}
    again["bounds_mm"] = [[0, 0, -2.9], [1, 1, 5]]
    report["programs"].append(again)
    rows = tools.cutters(report)
    assert [row["name"] for row in rows] == ["flat-3.175", "tapered-ball-1"]
    assert rows[0]["files"] == ["01-rough.nc", "2-01-rough.nc"]
    assert rows[0]["deep"] == 2.9
    assert ("tip", "1 mm") in rows[1]["measures"]
    assert ("shank", "3.175 mm") in rows[0]["measures"]


def test_programs_times_and_travel(report):
    first, second = tools.programs(report)
    assert (first["number"], second["number"]) == (1, 2)
    assert first["bounds"] == ["10 to 110", "12 to 80", "-2.5 to 5"]
    assert first["way"] == "5.0 m"
    assert tools.total(report) == "1 h 00 min"
    z = tools.reaches(report)[2]
    assert z == {"axis": "Z", "span": "-3 to 5 mm", "needs": "8 mm", "has": "34 mm"}
    assert tools.reaches({}) == []
