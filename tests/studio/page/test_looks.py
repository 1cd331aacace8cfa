import io

import numpy as np
import pytest
from PIL import Image

PHONE = {"width": 390, "height": 844}
CONTRASTS = """
(() => {
  const style = getComputedStyle(document.documentElement);
  const light = (name) => {
    const canvas = new OffscreenCanvas(1, 1).getContext('2d');
    canvas.fillStyle = style.getPropertyValue(name);
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((value) => value / 255)
      .map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = ([a, b]) => {
    const [low, high] = [light(a), light(b)].sort((x, y) => x - y);
    return (high + 0.05) / (low + 0.05);
  };
  return [['--ink', '--paper'], ['--soft', '--surface'], ['--soft', '--stage-far'],
    ['--accent', '--surface'], ['--on-accent', '--accent'], ['--wrong', '--wrong-surface']]
    .map((pair) => [pair.join(' on '), contrast(pair)]);
})()
"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_readable_in_light_and_dark(carver, scheme):
    carver.page.emulate_media(color_scheme=scheme)
    # Contrast (minimum) of WCAG 2.2, success criterion 1.4.3.
    assert [pair for pair, contrast in carver.sees(CONTRASTS) if contrast < 4.5] == []
    page = np.asarray(Image.open(io.BytesIO(carver.page.screenshot())).convert("L"))
    assert (np.median(page) < 90) == (scheme == "dark")


def test_a_phone_shows_all_of_it(carver):
    carver.page.set_viewport_size(PHONE)
    carver.sees("document.querySelectorAll('details').forEach((each) => (each.open = true))")
    for tab in ("model", "lines", "relief", "toolpaths", "deviation"):
        carver.goes_to(tab)
        assert carver.sees("document.scrollingElement.scrollWidth") <= PHONE["width"]
        view = carver.page.locator("#view").bounding_box()
        assert view["width"] > 350
        assert view["height"] > 250
    export = carver.page.locator("#export").bounding_box()
    assert export["x"] + export["width"] <= PHONE["width"]
    carver.page.locator("[data-name=depth] input[type=range]").scroll_into_view_if_needed()


def test_nothing_moves_for_those_who_asked_for_stillness(carver):
    carver.page.emulate_media(reduced_motion="reduce")
    name = "getComputedStyle(document.getElementById('busy'), '::before').animationName"
    assert carver.sees(name) == "none"
