import json
import re
import shutil
import signal
import subprocess
import sys
import time
import zipfile

import numpy as np
import pytest
import trimesh
from PIL import Image

from relieffab.cli.main import run

SMALL = ["--size", "40x30mm", "--resolution", "160x120", "--depth", "1.5mm", "--margin", "3mm"]


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    ball = trimesh.creation.icosphere(subdivisions=4)
    v = np.array(ball.vertices) * [3, 2, 1.5]
    v *= 1 + 0.05 * np.sin(5 * v[:, :1]) * np.sin(4 * v[:, 1:2])
    path = tmp_path_factory.mktemp("model") / "ball.obj"
    trimesh.Trimesh(v, ball.faces, process=False).export(path)
    return path


@pytest.fixture(scope="module")
def made(model, tmp_path_factory):
    """The folder that make left for a small job."""
    folder = tmp_path_factory.mktemp("make") / "job"
    assert run(["make", str(model), *SMALL, "-o", str(folder)]) == 0
    return folder


def test_make_leaves_exactly_the_files_of_a_job(made):
    found = sorted(str(p.relative_to(made)) for p in made.rglob("*") if p.is_file())
    assert found == [
        "00-outline.nc",
        "01-rough.nc",
        "02-finish.nc",
        "03-lines.nc",
        "deviation.png",
        "layers/depth.png",
        "layers/lambert.png",
        "layers/lines.png",
        "layers/lines.svg",
        "look.png",
        "panel.3mf",
        "panel.stl",
        "preview.png",
        "relief.png",
        "relief.tiff",
        "report.html",
        "report.json",
        "stock.step",
    ]
    assert not [p for p in made.parent.iterdir() if p.name.startswith(".")]


def test_the_report_has_schema_1(made):
    report = json.loads((made / "report.json").read_text())
    assert report["schema"] == 1
    assert set(report["view"]) == {
        "azimuth_deg", "elevation_deg", "roll_deg", "perspective_deg", "up", "matrix",
    }  # fmt: skip
    assert set(report["relief"]) >= {
        "file", "rows", "cols", "pitch_mm", "origin_mm", "depth_mm", "energy", "iterations",
        "seconds",
    }  # fmt: skip
    assert set(report["relief"]["energy"]) == {"depth", "light", "line", "form", "total"}
    assert set(report["panel"]) >= {
        "file", "triangles", "watertight", "volume_mm3", "max_error_mm",
    }  # fmt: skip
    for program in report["programs"]:
        assert set(program) >= {"file", "cutter", "lines", "seconds", "bounds_mm"}
    assert set(report["verification"]) >= {
        "gouge_mm", "excess_p99_mm", "within_tolerance", "tolerance_mm", "ok",
    }  # fmt: skip
    assert report["panel"]["watertight"]
    assert report["panel"]["max_error_mm"] <= 0.02
    assert report["verification"]["ok"]
    assert report["verification"]["gouge_mm"] <= 0.02
    assert report["verification"]["within_tolerance"] >= 0.95


def test_the_panel_is_the_slab_less_the_relief(made):
    from relieffab.relief.store import read_relief

    report = json.loads((made / "report.json").read_text())
    relief = read_relief(made / "relief.tiff")
    h = relief.heights
    # Two triangles a pixel: the mean of their corners times half a pixel each.
    cells = (2 * h[:-1, :-1] + h[1:, :-1] + h[:-1, 1:] + 2 * h[1:, 1:]) / 6
    volume = 40 * 30 * 12 + cells.sum() * relief.grid.pitch**2
    assert report["panel"]["volume_mm3"] == pytest.approx(volume, rel=1e-3)
    solid = trimesh.load_mesh(made / "panel.stl")
    assert solid.is_volume
    assert solid.volume == pytest.approx(volume, rel=1e-3)


def test_stage_by_stage_gives_the_same_programs(made, model, tmp_path, capsys):
    folder = tmp_path / "job"
    assert run(["relief", str(model), *SMALL, "-o", str(folder)]) == 0
    assert not (folder / "panel.stl").exists()
    assert run(["panel", str(folder)]) == 0
    assert run(["toolpath", str(folder)]) == 0
    assert run(["verify", str(folder)]) == 0
    ours, theirs = (json.loads((f / "report.json").read_text()) for f in (folder, made))
    assert ours["panel"]["volume_mm3"] == pytest.approx(theirs["panel"]["volume_mm3"])
    for one, other in zip(ours["programs"], theirs["programs"], strict=True):
        assert one["cutter"] == other["cutter"]
        # Heights and strokes come back from files in single precision and to 0.001 mm.
        assert one["cut_mm"] == pytest.approx(other["cut_mm"], rel=0.01)
        assert np.allclose(one["bounds_mm"], other["bounds_mm"], atol=0.02)


def test_a_panel_comes_in_the_formats_asked_for(made, tmp_path):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    assert run(["panel", str(folder), "--formats", "GLB, 3mf"]) == 0
    assert sorted(p.name for p in folder.glob("panel.*")) == ["panel.3mf", "panel.glb"]
    report = json.loads((folder / "report.json").read_text())
    assert report["panel"]["files"] == ["panel.3mf", "panel.glb"]
    with zipfile.ZipFile(folder / "panel.3mf") as package:
        picture = Image.open(package.open("Metadata/thumbnail.png"))
        assert picture.width == min(512, Image.open(folder / "preview.png").width)
    assert list(trimesh.load_scene(folder / "panel.glb").geometry) == ["relief of ball.obj"]
    assert run(["panel", str(folder), "--formats", "stp"]) == 2
    assert (folder / "panel.glb").is_file()


def test_a_template_is_added_and_goes_with_a_new_relief(made, model, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    assert run(["template", str(folder), "--paper", "letter"]) == 0
    assert "template.pdf  1 page of letter" in capsys.readouterr().out
    report = json.loads((folder / "report.json").read_text())
    assert report["template"]["files"] == ["template.svg", "contours.svg", "template.pdf"]
    assert all((folder / file).is_file() for file in report["template"]["files"])
    assert (folder / "panel.stl").is_file()
    assert run(["template", str(folder), "--paper", "a5"]) == 2
    assert "a4 or letter" in capsys.readouterr().err
    (folder / "layers" / "lines.svg").unlink()
    assert run(["template", str(folder)]) == 2
    assert (folder / "template.pdf").is_file()
    assert run(["relief", str(model), *SMALL, "-o", str(folder), "--overwrite"]) == 0
    assert not list(folder.glob("template.*")) + list(folder.glob("contours.*"))


def test_other_tools_give_other_programs_and_nothing_else(made, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    assert run(["toolpath", str(folder), "--material", "hardwood", "--rough", "flat-6"]) == 0
    report = json.loads((folder / "report.json").read_text())
    assert report["settings"]["material"] == "hardwood"
    assert report["programs"][0]["cutter"]["name"] == "flat-6"
    assert report["relief"] == json.loads((made / "report.json").read_text())["relief"]
    assert "careful guess" in capsys.readouterr().err
    for settled in (["--depth", "0.5mm"], ["--view", "left"], ["--size", "60x50mm"]):
        assert run(["toolpath", str(folder), *settled]) == 2


def test_a_new_relief_leaves_no_old_programs_behind(made, model, tmp_path):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    (folder / "mine.txt").write_text("mine")
    assert run(["relief", str(model), *SMALL, "-o", str(folder), "--overwrite"]) == 0
    assert not list(folder.glob("*.nc")) + list(folder.glob("panel.*"))
    assert (folder / "mine.txt").read_text() == "mine"


def test_a_bed_gives_parts_and_a_larger_one_takes_them_away(made, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    (folder / "panel-mine.stl").write_text("mine")
    assert run(["panel", str(folder), "--bed", "30x40mm", "--clearance", "0.1mm"]) == 0
    assert "panel-A2.stl" in capsys.readouterr().out
    panel = json.loads((folder / "report.json").read_text())["panel"]
    assert [tile["file"] for tile in panel["tiles"]] == ["panel-A1.stl", "panel-A2.stl"]
    assert [tile["place_mm"] for tile in panel["tiles"]] == [[0.0, 0.0], [20.0, 0.0]]
    for tile in panel["tiles"]:
        solid = trimesh.load_mesh(folder / tile["file"])
        assert solid.is_volume
        assert solid.volume == pytest.approx(tile["volume_mm3"], rel=1e-6)
    assert run(["panel", str(folder), "--bed", "40x30mm"]) == 0
    assert json.loads((folder / "report.json").read_text())["panel"]["tiles"] == []
    assert [p.name for p in folder.glob("panel-*")] == ["panel-mine.stl"]
    assert run(["panel", str(folder), "--bed", "20x30mm"]) == 2
    assert "too small for their tongues" in capsys.readouterr().err
    assert (folder / "panel.stl").is_file()


def test_plaque_and_mould_lie_beside_the_panel(made, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    before = json.loads((folder / "report.json").read_text())
    for solid in ("plaque", "mould"):
        assert run(["panel", str(folder), "--solid", solid]) == 0
        assert f"{solid}.stl" in capsys.readouterr().out
    report = json.loads((folder / "report.json").read_text())
    assert report["panel"] == before["panel"]
    assert report["picture"] == before["picture"]
    assert report["mould"]["findings"] == []
    assert report["mould"]["draft"]["least_deg"] > 3
    for solid in ("panel", "plaque", "mould"):
        read = trimesh.load_mesh(folder / f"{solid}.stl")
        assert read.is_volume
        assert read.volume == pytest.approx(report[solid]["volume_mm3"], rel=1e-6)
        assert (folder / f"{solid}.3mf").is_file()
        assert report[solid]["max_error_mm"] <= 0.02
    assert "<h2>Mould</h2>" in (folder / "report.html").read_text()


def test_a_mould_that_holds_its_cast_is_written_and_told(made, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    assert run(["panel", str(folder), "--solid", "mould", "--draft", "30deg"]) == 1
    told = capsys.readouterr()
    assert "will not come free" in told.err
    part = json.loads((folder / "report.json").read_text())["mould"]
    assert len(part["findings"]) == 1
    assert part["draft"]["least_deg"] < 30
    assert 0 < part["draft"]["share"] < part["draft"]["walls_share"] <= 1
    assert trimesh.load_mesh(folder / "mould.stl").is_volume
    # What a mould was found to be is no finding of the panel's.
    assert run(["panel", str(folder), "--solid", "panel"]) == 0
    assert run(["panel", str(folder), "--solid", "mould", "--draft", "60deg"]) == 2
    assert json.loads((folder / "report.json").read_text())["mould"] == part


def test_verify_believes_neither_report_nor_profiles(made, tmp_path, monkeypatch, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    report = json.loads((folder / "report.json").read_text())
    left_out = {**report, "programs": report["programs"][:2]}
    (folder / "report.json").write_text(json.dumps(left_out))
    assert run(["verify", str(folder)]) == 1
    assert "03-lines.nc lies in the folder" in capsys.readouterr().err
    (folder / "report.json").write_text(json.dumps({**report, "programs": [{}]}))
    assert run(["verify", str(folder)]) == 2
    (folder / "report.json").write_text(json.dumps(report))
    with (folder / "02-finish.nc").open("a") as file:
        file.write("(by hand)\n")
    assert run(["verify", str(folder)]) == 0
    assert "02-finish.nc was changed" in capsys.readouterr().err
    (folder / "02-finish.nc").unlink()
    assert run(["verify", str(folder)]) == 2
    (folder / "relief.tiff").write_bytes((folder / "relief.tiff").read_bytes()[:9000])
    assert run(["verify", str(folder)]) == 2


def test_a_job_file_without_a_model_is_refused(tmp_path, capsys):
    (tmp_path / "job.toml").write_text('depth = "3mm"\n')
    assert run(["make", str(tmp_path / "job.toml"), "-o", str(tmp_path / "out")]) == 2
    assert "names no model" in capsys.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.usefixtures("heard")
def test_a_job_that_is_stopped_leaves_nothing(model, tmp_path, number):
    command = [sys.executable, "-m", "relieffab", "make", str(model), "-o", str(tmp_path / "out")]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    waited = 0
    while not list(tmp_path.glob(".out-*")) and waited < 600:
        time.sleep(0.1)
        waited += 1
    process.send_signal(number)
    _, told = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "interrupted" in told
    assert "Traceback" not in told
    assert list(tmp_path.iterdir()) == []


def test_a_program_that_was_changed_is_judged(made, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    lines = (folder / "02-finish.nc").read_text().splitlines()
    depths = {k: re.search(r"Z(-[0-9.]+)", line) for k, line in enumerate(lines) if "(" not in line}
    depth, place = min((float(found[1]), k) for k, found in depths.items() if found)
    lines.insert(place + 1, f"G1 Z{depth - 0.5:.3f} F100")
    (folder / "02-finish.nc").write_text("\n".join(lines) + "\n")
    assert run(["verify", str(folder)]) == 1
    assert "DOES NOT carve" in capsys.readouterr().out


def test_send_asks_for_the_certificate(made, tmp_path, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    finish, port = folder / "02-finish.nc", ["--port", "sim://?speed=max"]
    sound = finish.read_text()
    assert run(["send", str(finish), *port]) == 0
    assert "proved" not in capsys.readouterr().err

    finish.write_text("(by hand)\n" + sound)
    assert run(["send", str(finish), *port]) == 0
    assert "not as it was proved; judged again, it carves" in capsys.readouterr().err

    depths = [k for k, line in enumerate(sound.splitlines()) if re.match(r"X.*Z-0\.[3-9]", line)]
    lines = sound.splitlines()
    lines[depths[9]] = re.sub(r"Z-[0-9.]+", "Z-1.4", lines[depths[9]])
    finish.write_text("\n".join(lines) + "\n")
    assert run(["send", str(finish), *port]) == 1
    told = capsys.readouterr()
    assert "does not carve the relief; nothing sent" in told.err and "gouges" in told.err
    assert "carved" not in told.out

    outline = folder / "00-outline.nc"
    assert run(["send", str(outline), *port]) == 0
    outline.write_text(outline.read_text().replace("Z5", "Z-5"))
    assert run(["send", str(outline), *port]) == 1
    assert "not as the job wrote it" in capsys.readouterr().err

    finish.write_text(sound[: len(sound) // 2])
    assert run(["send", str(finish), *port]) == 2
    assert run(["send", str(folder / "01-rough.nc"), *port]) == 0
    shutil.copy(folder / "01-rough.nc", folder / "mine.nc")
    assert run(["send", str(folder / "mine.nc"), *port]) == 0
    assert "nobody proved it" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--units", "cm"], "mm or in"),
        (["--work-zero", "middle"], "near-left or near"),
        (["--cutter-change", "pause"], "changes no cutters within a program"),
        (["--machine", ""], "no machine ''"),
        (["--machine", "minimil"], "did you mean minimill"),
    ],
)
def test_programs_that_cannot_be_are_refused(made, tmp_path, flags, words, capsys):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    before = {p.name: p.read_bytes() for p in folder.glob("*.*")}
    assert run(["toolpath", str(folder), *flags]) == 2
    assert words in capsys.readouterr().err
    assert {p.name: p.read_bytes() for p in folder.glob("*.*")} == before


def test_one_program_in_inches_from_under_the_middle(made, tmp_path):
    folder = tmp_path / "job"
    shutil.copytree(made, folder)
    flags = ["--machine", "altmill-4x4", "--units", "in", "--cutter-change", "pause"]
    place = ["--work-zero", "centre", "--work-zero-z", "bottom"]
    assert run(["toolpath", str(folder), *flags, *place]) == 0
    report = json.loads((folder / "report.json").read_text())
    assert sorted(p.name for p in folder.glob("*.nc")) == ["00-outline.nc", "programs.nc"]
    assert [part["file"] for part in report["programs"]] == ["programs.nc"] * 3
    (x0, y0, z0), (x1, y1, z1) = report["programs"][1]["bounds_mm"]
    assert x0 < 0 < x1 and y0 < 0 < y1 and 10 < z0 < 12 < z1
    text = (folder / "programs.nc").read_text()
    assert "\nM6 T3\n" in text and "\nG20 G90" in text
    assert run(["verify", str(folder)]) == 0


def test_layers_alone(model, tmp_path):
    folder = tmp_path / "job"
    assert run(["layers", str(model), *SMALL, "-o", str(folder)]) == 0
    assert (folder / "layers" / "lines.svg").is_file()
    assert not (folder / "relief.tiff").exists()


def test_a_job_file_makes_a_job(model, tmp_path, capsys):
    job = tmp_path / "job.toml"
    assert run(["init", str(job)]) == 0
    text = job.read_text().replace('# model = ""', f'model = "{model}"')
    text = text.replace('size = "120x90mm"', 'size = "4x3cm"')
    text = text.replace('resolution = "1024x768"', 'resolution = "160x120"')
    job.write_text(text.replace('margin = "6mm"', 'margin = "3mm"'))
    assert run(["layers", str(job), "-o", str(tmp_path / "out")]) == 0
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["model"]["name"] == "ball.obj"
    assert report["settings"]["size"] == "4x3cm"
    assert run(["init", str(job)]) == 2


def test_every_setting_is_told_with_its_origin(model, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("RELIEFFAB_DEPTH", "0.1in")
    monkeypatch.setenv("RELIEFFAB_MARGIN", "9mm")
    (tmp_path / "job.toml").write_text('margin = "1mm"\nview = "back"\ndepth = 3\n')
    arguments = ["make", str(tmp_path / "job.toml"), "--margin", "2mm", "-o", "x", "--json"]
    assert run([*arguments, "--show-config"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["margin"] == {"value": "2mm", "origin": "flag"}
    assert shown["depth"] == {"value": "0.1in", "origin": "RELIEFFAB_DEPTH"}
    assert shown["view"] == {"value": "back", "origin": str(tmp_path / "job.toml")}
    assert shown["material"]["origin"] == "default"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--size", "0x90mm"], "size"),
        (["--size", "5000x4000mm"], "larger than the machine"),
        (["--size", "120mm"], "width x height"),
        (["--size", "120x90furlong"], "unknown unit"),
        (["--depth", "0"], "more than 0"),
        (["--depth", "-1mm"], "more than 0"),
        (["--depth", "nan"], "not a length"),
        (["--depth", "30mm", "--thickness", "12mm"], "through the stock"),
        (["--depth", "25mm", "--thickness", "40mm"], "flute"),
        (["--machine", "3018-provr"], "did you mean 3018-prover"),
        (["--material", "soft-wood"], "did you mean softwood"),
        (["--finish", "ball-11"], "ball-1"),
        (["--view", "frnt"], "did you mean front"),
        (["--margin", "45mm"], "margin"),
        (["--resolution", "1024"], "1024x768"),
        (["--resolution", "4x4"], "16 to 16384"),
        (["--stepover", "9mm"], "stepover"),
        (["--stepover", "0"], "more than 0"),
        (["--stepover", "1um"], "stepover"),
        (["--scallop", "9mm"], "scallop"),
        (["--rows", "sideways"], "along, across, both, or an angle"),
        (["--milling", "up"], "either or climb"),
        (["--roll="], "roll"),
        (["--up", "x"], "y or z"),
        (["--wall-angle", "95"], "wall"),
        (["--perspective", "150"], "angle of view"),
        (["--line-kinds", "outline, countour"], "did you mean contour"),
        (["--line-kinds", ","], "needs a kind of line"),
        (["--line-length", "-1mm"], "0 or more"),
        (["--line-spread", "wide"], "not a length"),
        (["--method", "lineer"], "did you mean linear"),
        (["--solid", "statue"], "panel or plaque or mould"),
        (["--draft", "50deg"], "0 to 45 degrees"),
        (["--bed", "220mm"], "width x height"),
        (["--bed", "20x30mm"], "too small for their tongues"),
        (["--bed", "30x30mm", "--thickness", "3mm"], "too thin for tongues"),
        (["--bed", "30x30mm", "--clearance", "2mm"], "clearance"),
        (["--formats", "stl,gbl"], "did you mean glb"),
        (["--formats", ","], "needs a format"),
    ],
)
def test_settings_that_make_no_sense_leave_nothing(model, tmp_path, capsys, arguments, words):
    folder = tmp_path / "out"
    small = dict(zip(SMALL[::2], SMALL[1::2], strict=True))
    given = {word for word in arguments if word.startswith("--")}
    kept = [word for name, value in small.items() if name not in given for word in (name, value)]
    flags = [*kept, *arguments]
    assert run(["make", str(model), *flags, "-o", str(folder)]) == 2
    told = capsys.readouterr().err
    assert words in told
    assert "Traceback" not in told
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_holds_a_job_is_left_alone(made, model, capsys):
    before = (made / "report.json").read_bytes()
    assert run(["make", str(model), *SMALL, "-o", str(made)]) == 2
    assert "already holds a job" in capsys.readouterr().err
    assert (made / "report.json").read_bytes() == before


def test_an_output_that_is_a_file_is_refused(model, tmp_path, capsys):
    (tmp_path / "out").write_text("mine")
    assert run(["make", str(model), *SMALL, "-o", str(tmp_path / "out")]) == 2
    assert (tmp_path / "out").read_text() == "mine"


def test_unknown_commands_and_flags_are_usage_errors(capsys):
    assert run(["carve"]) == 2
    assert run(["make", "x.stl", "-o", "y", "--siez", "3"]) == 2
    assert run(["make"]) == 2


def test_a_folder_without_a_job_is_told(tmp_path, capsys):
    for command in ("panel", "template", "toolpath", "verify"):
        assert run([command, str(tmp_path)]) == 2
        assert "holds no job" in capsys.readouterr().err


def test_a_program_runs_on_the_simulated_machine(made, capsys):
    assert run(["send", str(made / "03-lines.nc"), "--port", "sim://?speed=max", "--json"]) == 0
    sent = json.loads(capsys.readouterr().out)
    program = json.loads((made / "report.json").read_text())["programs"][2]
    assert sent["cut_mm"] == pytest.approx(program["cut_mm"], rel=0.01)


def test_a_port_that_is_not_there_is_the_machines_fault(made, capsys):
    assert run(["send", str(made / "03-lines.nc"), "--port", "/dev/ttyNOWHERE"]) == 3


def test_machines_are_listed(capsys):
    assert run(["machines"]) == 0
    assert "3018-prover" in capsys.readouterr().out
    assert run(["machines", "cutters", "tapered-ball-1", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)[0]["tip_diameter"] == 1.0


def test_help_loads_nothing_heavy():
    code = (
        "import sys; from relieffab.cli.main import run; run(['--help']);"
        "bad = {'numpy', 'numba', 'trimesh', 'scipy', 'cadquery', 'starlette'} & set(sys.modules);"
        "sys.exit(repr(bad) if bad else 0)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)


def test_a_classic_method_makes_a_relief_and_says_so(model, tmp_path, capsys):
    folder = tmp_path / "job"
    arguments = ["relief", str(model), *SMALL, "--method", "linear", "-o", str(folder), "--json"]
    assert run(arguments) == 0
    told = capsys.readouterr()
    part = json.loads(told.out)["relief"]
    assert part["method"] == "linear"
    assert part["energy"] is part["iterations"] is part["residual"] is part["converged"] is None
    assert "not solved" not in told.err
    assert json.loads((folder / "report.json").read_text())["settings"]["method"] == "linear"


def test_our_own_method_is_named_too(made):
    assert json.loads((made / "report.json").read_text())["relief"]["method"] == "sunken"


def test_a_framed_arched_panel_with_holes_is_made_and_proved(model, tmp_path):
    folder = tmp_path / "job"
    shape = ["--outline", "arched", "--corner", "3mm", "--frame", "4mm", "--frame-height", "2mm"]
    shape += ["--frame-edge", "chamfer 0.5mm", "--keyholes", "20x40mm"]
    small = ["--size", "40x50mm", "--resolution", "120x150", "--depth", "1.5mm", "--margin", "5mm"]
    assert run(["make", str(model), *small, *shape, "-o", str(folder)]) == 0
    report = json.loads((folder / "report.json").read_text())
    assert (report["stock"]["file"], report["stock"]["frame"]) == ("stock.step", "frame.step")
    assert report["slab"]["frame"]["height"] == 2
    # To the first cut and home the cutter goes over the frame.
    rapids = re.findall(r"^G0.*Z([\d.]+)", (folder / "01-rough.nc").read_text(), re.M)
    assert max(float(z) for z in rapids) > 2 + 3
    solid = trimesh.load_mesh(folder / "panel.stl")
    assert solid.is_volume
    assert solid.bounds[1, 2] == 2
    assert run(["verify", str(folder)]) == 0
    assert run(["panel", str(folder), "--solid", "mould"]) == 2
    assert run(["panel", str(folder), "--bed", "30x30mm"]) == 2


def test_a_reader_that_leaves_is_no_fault_of_ours():
    command = f"{sys.executable} -m relieffab machines | true"
    ran = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
    assert ran.stderr == ""
