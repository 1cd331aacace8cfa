NAMELESS = """
[...document.querySelectorAll('button, input, select, [tabindex="0"], summary')]
  .filter((each) => each.checkVisibility() && !each.disabled)
  .filter((each) => !(each.getAttribute('aria-label') || each.getAttribute('aria-labelledby') ||
    each.labels?.length || each.textContent.trim()))
  .map((each) => each.outerHTML.slice(0, 80))
"""
FOCUS = "document.activeElement.id || document.activeElement.getAttribute('aria-label')"


def test_all_by_keyboard(carver):
    press = carver.page.keyboard.press
    carver.sees("document.activeElement.blur()")
    press("Tab")
    assert carver.sees("document.activeElement.className") == "skip"
    way = []
    for _ in range(14):
        press("Tab")
        way.append(carver.sees(FOCUS))
    assert way[:2] == ["open", "export"] or {"open", "undo", "export"} <= set(way)
    assert {"tab-model", "view", "set-depth"} <= set(way)

    carver.page.focus("#tab-model")
    for _ in range(4):
        press("ArrowRight")
    assert carver.sees(FOCUS) == "tab-relief"
    carver.calm()
    carver.page.focus("[data-name=depth] input[type=range]")
    press("ArrowRight")
    carver.calm()
    assert carver.setting("depth") == "3.1mm"
    assert carver.is_shown_what_it_asked()["depth_mm"] == 3.1

    azimuth = "studio.show.views.relief.rig.azimuth"
    stood = carver.sees(azimuth)
    carver.page.focus("#view")
    press("ArrowLeft")
    assert carver.sees(azimuth) != stood
    carver.page.focus("#sun")
    told = carver.page.get_attribute("#sun", "aria-valuetext")
    for _ in range(4):
        press("ArrowDown")
    assert carver.page.get_attribute("#sun", "aria-valuetext") != told


def test_the_model_turns_by_arrow_keys(carver):
    carver.goes_to("model")
    carver.page.focus("#view")
    carver.page.keyboard.press("ArrowLeft")
    carver.page.keyboard.press("e")
    carver.calm()
    assert carver.setting("azimuth") == "4.8deg"
    assert carver.setting("roll") == "-4.8deg"
    carver.page.keyboard.press("0")
    carver.calm()
    assert carver.setting("azimuth") == ""


def test_focus_is_seen_and_everything_has_a_name(carver):
    carver.sees("document.querySelectorAll('details').forEach((each) => (each.open = true))")
    for tab in ("model", "relief", "toolpaths"):
        carver.goes_to(tab)
        assert carver.sees(NAMELESS) == []
    carver.page.focus("#tab-toolpaths")
    carver.page.keyboard.press("ArrowLeft")
    outline = "getComputedStyle(document.activeElement).outlineStyle"
    assert carver.sees(outline) == "solid"
