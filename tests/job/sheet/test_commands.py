import shlex

from relieffab.cli.options import Options, settings_of
from relieffab.job.sheet.commands import commands


def lines(report):
    return [" ".join(parts) for parts in commands(report)]


def test_a_whole_job_is_one_command_of_what_is_not_by_default(report):
    assert lines(report) == ["relieffab make horse.ply --view right -o FOLDER"]


def test_the_command_leads_back_to_the_same_settings(made):
    report = made(model="my horse's.ply", frame_edge="fillet 1mm", frame="8mm", azimuth="-30deg")
    _, verb, model, *flags = shlex.split(lines(report)[0])
    assert (verb, model, flags[-2:]) == ("make", "my horse's.ply", ["-o", "FOLDER"])
    pairs = zip(flags[:-2:2], flags[1:-2:2], strict=True)
    typed = Options(**{name[2:].replace("-", "_"): text for name, text in pairs})
    again = {name: choice.text for name, choice in settings_of(model, typed).items()}
    assert {name: text for name, text in again.items() if text} == report["settings"]


def test_stages_are_named_one_by_one(report):
    del report["programs"]
    report["mould"] = {}
    report["template"] = {"paper": "a4"}
    assert lines(report) == [
        "relieffab relief horse.ply --view right -o FOLDER",
        "relieffab panel FOLDER",
        "relieffab panel FOLDER --solid mould",
        "relieffab template FOLDER --paper a4",
    ]
    del report["relief"], report["panel"], report["mould"], report["template"]
    assert lines(report) == ["relieffab layers horse.ply --view right -o FOLDER"]


def test_the_scarab_and_a_panel_of_several(report):
    del report["settings"]["model"], report["settings"]["view"]
    assert lines(report) == ["relieffab demo -o FOLDER"]
    report["reliefs"] = [{"model": {"name": "cow.obj"}, "place_mm": [10.0, 7.5]}]
    assert lines(report)[0] == "relieffab compose cow@10x7.5mm -o FOLDER"
    assert lines(report)[1:] == ["relieffab panel FOLDER", "relieffab toolpath FOLDER"]
