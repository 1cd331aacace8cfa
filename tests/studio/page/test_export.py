import tifffile

from relieffab.cli.main import run


def finished(person):
    person.waits("document.getElementById('exporting-title')?.textContent === 'Exported'")


def test_an_export_is_what_its_job_file_makes(carver, studio, tmp_path):
    carver.page.fill("#set-depth", "0.1in")
    carver.page.keyboard.press("Enter")
    carver.calm()
    carver.page.click("#export")
    finished(carver)
    links = carver.page.locator(".files a")
    names = links.all_inner_texts()
    assert {"relief.tiff", "panel.stl", "report.json", "job.toml"} <= set(names)
    with carver.page.expect_download() as loading:
        links.filter(has_text="relief.tiff").click()
    exported = tifffile.imread(loading.value.path())
    with carver.page.expect_download() as loading:
        carver.page.click("a[href='job.toml']")
    folder = next(studio.output.iterdir())
    assert str(folder) in carver.page.inner_text(".command")
    beside = loading.value.path().read_text().replace('"scarab.stl"', '"model/scarab.stl"')
    assert beside == (folder / "job.toml").read_text()
    assert run(["make", str(folder / "job.toml"), "-o", str(tmp_path / "made")]) == 0
    made = tifffile.imread(tmp_path / "made" / "relief.tiff")
    assert 2.0 < -made.min() <= 2.5401
    assert made.tobytes() == exported.tobytes()


def test_a_cancelled_export_leaves_nothing_behind(carver, studio):
    before = sorted(studio.output.glob("**/*"))
    carver.page.click("#export")
    carver.page.wait_for_selector("progress")
    carver.page.click("#exporting button")
    carver.waits("document.getElementById('exporting').hidden")
    assert "nothing is left behind" in carver.page.inner_text("#status")
    assert sorted(studio.output.glob("**/*")) == before
    assert carver.page.is_enabled("#export")
