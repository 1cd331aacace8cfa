import numpy as np
import tifffile
from PIL import Image

from relieffab.cli.main import run


def finished(person):
    person.waits("document.getElementById('exporting-title')?.textContent === 'Exported'")


MARKED = "{style: 'gouge', mark_spacing: '2mm', mark_depth: '0.3mm', mark_cutter: 'ball-3.175'}"


def test_an_export_is_what_its_job_file_makes(carver, studio, bump, tmp_path, monkeypatch):
    carver.opens(bump)
    mask = np.zeros((90, 120), np.uint8)
    mask[:, 20:] = 255
    Image.fromarray(mask).save(tmp_path / "mask.png")
    carver.page.set_input_files("[data-name=mask] input[type=file]", tmp_path / "mask.png")
    carver.waits("studio.store.settings.mask === 'mask.png'")
    carver.sees(f"studio.store.change({MARKED})")
    carver.page.fill("#set-depth", "0.1in")
    carver.page.keyboard.press("Enter")
    carver.calm()
    carver.page.click("#export")
    finished(carver)
    links = carver.page.locator(".files a")
    names = links.all_inner_texts()
    assert {"relief.tiff", "panel.stl", "report.json", "job.toml", "04-marks.nc"} <= set(names)
    assert {"model/bump.png", "model/mask.png"} <= set(names)
    with carver.page.expect_download() as loading:
        links.filter(has_text="relief.tiff").click()
    exported = tifffile.imread(loading.value.path())
    with carver.page.expect_download() as loading:
        carver.page.click("a[href='job.toml']")
    folder = studio.output / "bump"
    assert str(folder) in carver.page.inner_text(".command")
    beside = loading.value.path().read_text()
    for name in ("bump", "mask"):
        beside = beside.replace(f'"{name}.png"', f'"model/{name}.png"')
    assert beside == (folder / "job.toml").read_text()
    monkeypatch.chdir(folder)  # programs name their model as it was named
    assert run(["make", "job.toml", "-o", str(tmp_path / "made")]) == 0
    made = tifffile.imread(tmp_path / "made" / "relief.tiff")
    assert 2.0 < -made.min() <= 2.5401
    assert made.tobytes() == exported.tobytes()
    for name in ("04-marks.nc", "panel.stl", "layers/depth.png"):
        assert (tmp_path / "made" / name).read_bytes() == (folder / name).read_bytes()


def test_a_cancelled_export_leaves_nothing_behind(carver, studio):
    before = sorted(studio.output.glob("**/*"))
    carver.page.click("#export")
    carver.page.wait_for_selector("progress")
    carver.page.click("#exporting button")
    carver.waits("document.getElementById('exporting').hidden")
    assert "nothing is left behind" in carver.page.inner_text("#status")
    assert sorted(studio.output.glob("**/*")) == before
    assert carver.page.is_enabled("#export")
