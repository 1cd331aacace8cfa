"""The studio's page in a real browser: one studio and one browser for all tests here."""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from relieffab.job.table import TABLE
from relieffab.studio.controls import OFFERED
from relieffab.studio.frames import unpack

CHROMIUM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
ARGUMENTS = [
    "--no-sandbox",
    "--use-angle=swiftshader",  # WebGL without a graphics card
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--js-flags=--expose-gc",
    "--enable-precise-memory-info",
]
WINDOW = {"width": 900, "height": 620}
BEGUN = {"size": "40x30mm", "resolution": "96x72", "line_length": "2mm", "material": "foam"}
BEGUN |= {"scallop": "0.05mm"}
BEGUN |= {"up": "y"}  # of a file of triangles alone it would have to be guessed
PATIENCE = 400.0  # seconds: a studio that has never run compiles first


class Person:
    """Somebody before the page, who sees what it shows and hears what it complains of."""

    def __init__(self, page, url):
        self.page = page
        self.url = url
        self.faults = []
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.faults.append(error.stack or str(error)))
        page.on("requestfinished", self._follow)
        self.answered = None
        page.goto(url)

    def _hear(self, message):
        # A refused ask is told on the page; the browser writes it down, too.
        refused = message.text.startswith("Failed to load resource: the server responded")
        if message.type in ("error", "warning") and not refused:
            self.faults.append(message.text)

    def _follow(self, request):
        asked = request.url.endswith("/preview") and "relief" in request.post_data_json["want"]
        if asked and request.response().status == 200:
            self.answered = request

    def sees(self, expression):
        """What an expression comes to on the page."""
        return self.page.evaluate(expression)

    def waits(self, expression, seconds=PATIENCE):
        """Wait until an expression holds; by asking, for the page's policy forbids `eval`."""
        end = time.monotonic() + seconds
        while not self.sees(expression):
            assert time.monotonic() < end, f"never came true: {expression}"
            self.page.wait_for_timeout(30)

    def calm(self):
        """Wait until what is shown is of the settings as they stand."""
        self.waits(
            "document.getElementById('view').getAttribute('aria-busy') === 'false' &&"
            " document.getElementById('view').dataset.shown === String(studio.store.version)"
        )

    def opens(self, file):
        """Choose a model's file, and wait until it is shown."""
        if self.sees("document.getElementById('welcome').hidden"):
            self.calm()  # what was open before is no longer on its way
        before = self.sees("studio.store.version + studio.asking.count")
        self.page.set_input_files("#file", file)
        self.waits(f"studio.store.version + studio.asking.count > {before}")
        self.calm()

    def begins_anew(self):
        """Have all settings as they are by default."""
        defaults = {name: setting.default for name, setting in TABLE.items() if name in OFFERED}
        self.sees(f"studio.store.change({json.dumps({**defaults, **BEGUN})})")
        self.calm()

    def goes_to(self, tab):
        """Choose a tab, and wait until it shows what fits."""
        self.page.click(f"#tab-{tab}")
        self.calm()

    def heights(self):
        """The relief as it is shown, mm."""
        field = self.sees(
            "(({heights, rows, cols}) => ({heights: [...heights], rows, cols}))"
            "(studio.show.views.relief.slab.field)"
        )
        return np.array(field["heights"], np.float32).reshape(field["rows"], field["cols"])

    def is_shown_what_it_asked(self):
        """Whether the relief shown is the studio's last, and that of the settings as they stand."""
        told, arrays = unpack(self.answered.response().body())
        question = self.answered.post_data_json
        assert question["settings"] == self.sees("studio.store.settings")
        assert told["ask"] == question["ask"] == self.sees("studio.asking.count")
        assert arrays["heights"].tobytes() == self.heights().tobytes()
        return told

    def picture(self):
        """The view, as a PNG file."""
        self.page.wait_for_timeout(120)
        return self.page.locator("#view").screenshot()

    def setting(self, name):
        return self.sees(f"studio.store.settings[{json.dumps(name)}]")


@pytest.fixture(scope="session")
def browser():
    """A browser without a window; a test is skipped where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if CHROMIUM is None:
        pytest.skip("chromium is not installed; .ci/run does")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        yield browser
        browser.close()


class Studio:
    """A studio in a process of its own."""

    def __init__(self, output):
        self.output = output
        self.process = subprocess.Popen(
            [sys.executable, "-m", "relieffab", "studio", "--no-browser", "-o", str(output)]
            + [f"--{name.replace('_', '-')}={text}" for name, text in BEGUN.items()],
            stdout=subprocess.PIPE,
            text=True,
            cwd=output.parent,
            env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])},
        )
        self.url = self.process.stdout.readline().split()[-1]

    def end(self):
        self.process.terminate()
        self.process.wait(timeout=30)


@pytest.fixture(scope="session")
def studio(browser, tmp_path_factory):
    studio = Studio(tmp_path_factory.mktemp("studio") / "out")
    yield studio
    studio.end()


@pytest.fixture(scope="session")
def model(tmp_path_factory):
    """The scarab, coarsely, as a file of triangles alone."""
    import trimesh

    from relieffab.subject import scarab

    path = tmp_path_factory.mktemp("model") / "scarab.stl"
    trimesh.Trimesh(*scarab(cell=1.1), process=False).export(path)
    return path


@pytest.fixture
def person(browser, studio, tmp_path):
    """Somebody who has just opened the page; whatever it complained of fails the test.

    What it showed last is kept among pytest's own folders, last.png, to be looked at.
    """
    context = browser.new_context(viewport=WINDOW, accept_downloads=True)
    person = Person(context.new_page(), studio.url)
    person.waits("studio.store.version > 0 && document.querySelectorAll('.field').length > 0")
    person.sees("studio.asking.rest = 1e8")  # finer pictures have a test of their own
    yield person
    person.page.screenshot(path=tmp_path / "last.png")
    context.close()
    assert person.faults == []


@pytest.fixture
def carver(person, model):
    """Somebody with the scarab before them, settings as they are by default."""
    if person.page.inner_text("#model-name") != model.name:
        person.opens(model)
    person.begins_anew()
    return person


@pytest.fixture
def viewer(person, bump):
    """Somebody with a depth map before them, settings as they are by default."""
    if person.page.inner_text("#model-name") != bump.name:
        person.opens(bump)
    person.begins_anew()
    return person
