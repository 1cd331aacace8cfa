import numpy as np

from relieffab.layers.view import View

MATRIX = "studio.show.views.model.{}.elements"


def matrix(person, name):
    """A matrix of the model's view, (4, 4)."""
    return np.array(person.sees(MATRIX.format(name))).reshape(4, 4).T


def drag(person, dx, dy):
    box = person.page.locator("#canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    person.page.mouse.move(x, y)
    person.page.mouse.down()
    person.page.mouse.move(x + dx, y + dy, steps=4)
    person.page.mouse.up()


def test_a_model_is_turned_by_hand_and_its_lines_follow(carver):
    before = carver.picture()
    drag(carver, -150, 40)
    carver.calm()
    assert carver.picture() != before
    view = View(60.0, 16.0, 0.0, "y")
    assert carver.setting("azimuth") == "60deg"
    assert carver.setting("elevation") == "16deg"
    scale = np.linalg.norm(matrix(carver, "asked")[0, :3])
    assert np.allclose(matrix(carver, "asked")[:3, :3], scale * view.rotation, atol=1e-3 * scale)
    # The studio's camera and the page's agree, so the ink lies on the model.
    assert np.allclose(matrix(carver, "model.matrix"), matrix(carver, "asked"), atol=2e-3)
    assert carver.sees("studio.show.views.model.strokes.material.uniforms.fade.value") > 0.9


def test_page_and_studio_place_a_model_alike_in_perspective_too(carver):
    carver.sees("studio.store.change({azimuth: '33deg', roll: '-20deg', perspective: '50deg'})")
    carver.calm()
    page, studio = matrix(carver, "model.matrix"), matrix(carver, "asked")
    assert abs(studio[3, 2] + studio[3, 0]) > 0
    assert np.allclose(page / page[3, 3], studio / studio[3, 3], atol=2e-3)
    carver.sees("studio.store.change({perspective: '0deg'})")


def test_layers_are_shown_one_by_one(carver):
    pictures = []
    for tab in ("lines", "lambert", "depth"):
        carver.goes_to(tab)
        pictures.append(carver.picture())
    assert len(set(pictures)) == 3


def test_the_relief_follows_a_slider(carver):
    carver.goes_to("relief")
    shallow, before = carver.heights(), carver.picture()
    slider = carver.page.locator("[data-name=depth] input[type=range]").bounding_box()
    carver.page.mouse.move(slider["x"] + 60, slider["y"] + slider["height"] / 2)
    carver.page.mouse.down()
    for step in range(8):
        carver.page.mouse.move(slider["x"] + 60 + 12 * step, slider["y"] + slider["height"] / 2)
    carver.page.mouse.up()
    carver.calm()
    depth = float(carver.setting("depth").removesuffix("mm"))
    assert depth > 3.5
    assert carver.is_shown_what_it_asked()["depth_mm"] == depth
    assert -3.0 <= shallow.min() < -1.0
    assert -depth <= carver.heights().min() < 1.1 * shallow.min()
    assert carver.picture() != before
    # The hand's whole way is one step back.
    carver.page.keyboard.press("Control+z")
    carver.calm()
    assert carver.setting("depth") == "3mm"
    assert np.allclose(carver.heights(), shallow, atol=0.02)


def test_what_is_shown_grows_finer_when_the_hand_rests(carver):
    carver.goes_to("relief")
    coarse = carver.heights()
    carver.sees("studio.asking.rest = 10")
    carver.sees("studio.store.change({depth: '2mm'})")
    carver.waits("studio.asking.fine.relief === studio.store.version")
    carver.calm()
    assert carver.heights().shape[1] > 1.5 * coarse.shape[1]
    assert carver.is_shown_what_it_asked()["depth_mm"] == 2


def test_the_light_changes_the_picture_alone(carver):
    carver.goes_to("relief")
    heights, before = carver.heights(), carver.picture()
    asked = carver.sees("studio.asking.count")
    sun = carver.page.locator("#sun").bounding_box()
    carver.page.mouse.click(sun["x"] + 0.8 * sun["width"], sun["y"] + 0.75 * sun["height"])
    assert carver.picture() != before
    assert "lower right" in carver.page.get_attribute("#sun", "aria-valuetext")
    assert carver.sees("studio.asking.count") == asked
    assert np.array_equal(carver.heights(), heights)


def test_panel_toolpaths_and_deviation(carver):
    carver.goes_to("panel")
    assert carver.sees("studio.show.views.panel.solid.geometry.attributes.position.count") > 1000
    carver.goes_to("toolpaths")
    stock = "Math.min(...studio.show.views.toolpaths.slab.field.heights)"
    carver.waits(f"{stock} < -1.5")
    whole = carver.picture()
    carver.page.focus("#scrub")
    carver.page.keyboard.press("Home")
    carver.waits(f"{stock} === 0")
    carver.page.keyboard.press("PageUp")
    carver.waits(f"{stock} < -0.1")
    assert carver.picture() != whole
    carver.goes_to("deviation")
    assert "deepest gouge" in carver.page.inner_text("#tray")
