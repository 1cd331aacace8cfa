"""Pictures and drawings on the page, from the file to the relief; and marks."""

import io

import numpy as np
from PIL import Image

DISABLED = "document.getElementById('set-{}').disabled"
WHY = "document.getElementById(document.getElementById('set-{}')\
.getAttribute('aria-describedby').split(' ').at(-1)).textContent"
RING = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 80 60">
<path d="M10 50 40 5 70 50z" fill="#333"/><circle cx="40" cy="35" r="9" fill="white"/></svg>"""


def test_a_picture_is_told_what_it_was_taken_for_and_may_be_told_otherwise(viewer):
    assert viewer.page.inner_text("#tab-model") == "Picture"
    assert "a depth map, by its values" in viewer.page.inner_text("#tray")
    box = viewer.page.locator("#canvas").bounding_box()
    shown = np.asarray(Image.open(io.BytesIO(viewer.picture())).convert("L"), float)
    middle = shown[int(box["height"] / 2), int(box["width"] / 2)]
    assert middle > shown.min() + 100  # the dome's top is white, on black
    viewer.goes_to("relief")
    before = viewer.heights()
    viewer.sees("document.querySelectorAll('details').forEach((each) => (each.open = true))")
    assert viewer.sees("document.scrollingElement.scrollHeight <= innerHeight")
    viewer.page.focus("#set-image")
    viewer.page.keyboard.press("End")  # of the choices
    viewer.waits("studio.store.settings.image === 'normal-y-down'")
    viewer.waits("document.querySelectorAll('#messages .message').length === 1")
    viewer.sees("studio.store.change({image: 'depth-white-far'})")
    viewer.calm()
    assert viewer.page.inner_text("#messages") == ""
    far = viewer.heights()
    assert np.corrcoef(before[before < 0], far[before < 0])[0, 1] < 0.5
    viewer.page.keyboard.press("Control+z")
    viewer.page.keyboard.press("Control+z")
    viewer.calm()
    assert viewer.setting("image") == ""
    assert np.allclose(viewer.heights(), before, atol=0.02)


def test_a_mask_is_sent_undone_and_refused_where_it_does_not_fit(viewer, tmp_path):
    viewer.goes_to("relief")
    whole = (viewer.heights() < 0).sum()
    half = np.zeros((90, 120), np.uint8)
    half[:45] = 255
    Image.fromarray(half).save(tmp_path / "half.png")
    Image.fromarray(half[:80]).save(tmp_path / "short.png")
    chooser = "[data-name=mask] input[type=file]"
    viewer.page.set_input_files(chooser, tmp_path / "short.png")
    viewer.waits("document.querySelectorAll('#messages .message').length === 1")
    assert "does not fit" in viewer.page.inner_text("#messages")
    viewer.page.set_input_files(chooser, tmp_path / "half.png")
    viewer.waits("studio.store.settings.mask === 'half.png'")
    viewer.calm()
    assert viewer.page.inner_text("#messages") == ""
    assert viewer.sees("document.getElementById('set-mask').textContent") == "half.png"
    masked = (viewer.heights() < 0).sum()
    assert abs(masked - whole) > 0.1 * whole  # it fills the panel another way
    viewer.page.keyboard.press("Control+z")
    viewer.calm()
    assert (viewer.heights() < 0).sum() == whole


def test_what_a_picture_has_no_use_for_rests_and_says_why(viewer, model):
    assert viewer.sees(DISABLED.format("azimuth"))
    assert "Only a mesh can be turned" in viewer.sees(WHY.format("azimuth"))
    assert not viewer.sees(DISABLED.format("image_depth"))
    asked = viewer.sees("studio.asking.count")
    viewer.page.focus("#view")
    for key in ("ArrowLeft", "e", "0"):
        viewer.page.keyboard.press(key)
    assert viewer.sees("studio.asking.count") == asked
    viewer.opens(model)
    assert viewer.page.inner_text("#tab-model") == "Model"
    assert not viewer.sees(DISABLED.format("azimuth"))
    assert "Of pictures alone" in viewer.sees(WHY.format("image_depth"))


def test_marks_come_when_the_hand_rests(carver):
    carver.goes_to("relief")
    carver.sees("document.querySelectorAll('details').forEach((each) => (each.open = true))")
    carver.page.focus("#set-style")
    carver.page.keyboard.press("ArrowDown")  # to the flat chisel
    carver.page.keyboard.press("ArrowDown")
    carver.calm()
    assert carver.setting("style") == "gouge"
    assert "when the hand rests" in carver.page.inner_text("#status")
    assert carver.page.get_attribute("#set-mark_spacing", "placeholder") == "auto 1mm"
    assert carver.page.input_value("#set-mark_direction") == "form"
    assert (carver.heights()[:40, :40] == 0).all()
    carver.page.focus("#set-ground")
    carver.page.keyboard.press("ArrowDown")
    carver.sees("studio.asking.rest = 10")
    carver.page.focus("[data-name=mark_spacing] input[type=range]")
    carver.page.keyboard.press("ArrowRight")
    carver.waits("studio.asking.fine.relief === studio.store.version")
    carver.calm()
    assert "marks" in carver.page.inner_text("#times")
    ground = carver.heights()[:80, :80]  # 2.5 mm of it stay level along the panel's edge
    assert (ground[:32] == 0).all() and (ground[:, :32] == 0).all()
    assert 0.1 < (ground[36:, 36:] < -0.02).mean() < 0.9
    assert -0.26 < ground.min() < -0.1
    assert 'style = "gouge"' in carver.page.request.get(carver.url + "job.toml").text()


def test_an_svg_is_shown_and_sunk(person, tmp_path):
    (tmp_path / "ring.svg").write_text(RING)
    person.opens(tmp_path / "ring.svg")
    person.begins_anew()
    assert person.page.inner_text("#tab-model") == "Drawing"
    assert "level" in person.sees(WHY.format("form_length"))
    person.goes_to("relief")
    assert person.heights().min() == -3.0
