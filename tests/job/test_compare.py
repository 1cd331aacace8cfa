import io
import json

import numpy as np
import pytest
import trimesh
from PIL import Image

from relieffab.errors import InputError
from relieffab.job.compare import compare, percentages
from relieffab.job.settings import resolve
from relieffab.relief.names import NAMES
from relieffab.relief.window import figure_size


@pytest.fixture(scope="module")
def settings(tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "ball.obj"
    ball = trimesh.creation.icosphere(subdivisions=3)
    ball.apply_scale([3, 2, 1.5])
    ball.export(path)
    values = {"model": str(path), "size": "40x30mm", "resolution": "96x72", "margin": "3mm"}
    return resolve([("call", {**values, "up": "y"})])


@pytest.fixture(scope="module")
def compared(settings, tmp_path_factory):
    """The report and the folder of a small comparison, and what progress told."""
    folder = tmp_path_factory.mktemp("compare") / "out"
    told = []

    def listen(stage, done, total, unit=""):
        told.append((stage, done, total))

    return compare(settings, folder, depths=(5.0, 10.0), progress=listen), folder, told


def test_every_method_at_every_depth(compared):
    report, _, _ = compared
    got = [(r["percent"], r["method"]) for r in report["reliefs"]]
    assert got == [(percent, name) for percent in (5.0, 10.0) for name in NAMES]
    for row in report["reliefs"]:
        assert row["depth_mm"] == row["percent"] / 100 * report["figure_height_mm"]
        assert row["quality"]["border"]["outside"] == 0
        assert row["quality"]["border"]["beyond"] == 0
        assert (row["converged"] is None) == (row["method"] != "sunken")
    assert len({json.dumps(r["quality"]) for r in report["reliefs"]}) == len(report["reliefs"])


def test_the_files_are_what_was_returned(compared):
    report, folder, _ = compared
    assert json.loads((folder / "compare.json").read_text()) == report
    image = np.asarray(Image.open(io.BytesIO((folder / "compare.png").read_bytes())))
    assert image.ndim == 2
    assert image.shape[0] > len(NAMES) * 40
    assert np.ptp(image) > 200


def test_progress_only_goes_forward(compared):
    _, _, told = compared
    done = [part for stage, part, _ in told if stage == "compare"]
    assert done == sorted(done)
    assert done[-1] == 2 * len(NAMES)


def test_a_job_in_the_folder_stays(settings, tmp_path):
    (tmp_path / "report.json").write_text("mine")
    with pytest.raises(InputError, match="already holds"):
        compare(settings, tmp_path, depths=(5.0,))
    compare(settings, tmp_path, depths=(5.0,), overwrite=True)
    assert (tmp_path / "report.json").read_text() == "mine"
    assert (tmp_path / "compare.json").is_file()


def test_the_height_of_the_figure(layers):
    rows = np.nonzero(layers.mask.any(axis=1))[0]
    assert figure_size(layers)[0] == pytest.approx((rows[-1] - rows[0] + 1) * layers.pitch)


def test_depths_are_sorted():
    assert percentages("10, 2%,5") == (2.0, 5.0, 10.0)


@pytest.mark.parametrize("text", ["", "0", "-2", "101", "inf", "nan", "2;5", "2,2"])
def test_depths_that_are_none(text):
    with pytest.raises(InputError, match="percentages"):
        percentages(text)
