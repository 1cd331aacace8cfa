"""Somebody who presses everything: no fault, no growing memory, nothing stale."""

import os
import random
import time

import pytest

TABS = ("model", "model", "lines", "lambert", "depth", "relief", "relief", "relief", "panel")
SLIDERS = ("depth", "line_depth", "line_width", "line_detail", "form_length")
HEAP = "(gc(), gc(), performance.memory.usedJSHeapSize / 2 ** 20)"
CARD = "(({geometries, textures}) => geometries + textures)(studio.show.stage.renderer.info.memory)"


def slide(person, chance):
    slider = person.page.locator(f"[data-name={chance.choice(SLIDERS)}] input[type=range]")
    box = slider.bounding_box()
    y = box["y"] + box["height"] / 2
    person.page.mouse.move(box["x"] + chance.random() * box["width"], y)
    person.page.mouse.down()
    for _ in range(chance.randrange(1, 8)):
        person.page.mouse.move(box["x"] + chance.random() * box["width"], y)
    person.page.mouse.up()


def turn(person, chance):
    box = person.page.locator("#canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    person.page.mouse.move(x, y)
    person.page.mouse.down(button=chance.choice(("left", "left", "left", "right")))
    for _ in range(chance.randrange(1, 8)):
        x, y = x + chance.uniform(-40, 40), y + chance.uniform(-30, 30)
        person.page.mouse.move(x, y)
    person.page.mouse.up()
    person.page.mouse.up(button="right")


def press(person, chance):
    person.page.focus(chance.choice(("#view", "#view", "#undo", "body")))
    keys = ("ArrowLeft", "ArrowUp", "+", "-", "0", "q", "e", "Control+z", "Control+z", "Control+y")
    person.page.keyboard.press(chance.choice(keys))


def switch(person, chance):
    person.page.click(f"#tab-{chance.choice(TABS)}")


def look(person, chance):
    if person.page.is_visible(".named"):
        person.page.locator(".named button").nth(chance.randrange(6)).click()


ACTS = (slide, slide, slide, turn, turn, press, switch, look)


def shown_is_asked(person):
    """Whether the relief on the page is the one its settings make, worked out anew."""
    person.goes_to("relief")
    shown = person.heights()
    person.sees("studio.store.adopt({})")
    person.calm()
    assert abs(shown - person.heights()).max() < 0.05
    assert "mm" in person.setting("depth")
    assert abs(shown.min() + float(person.setting("depth").removesuffix("mm"))) < 1e-3


def test_whatever_is_pressed_the_last_asked_is_the_last_shown(carver):
    minutes = float(os.environ.get("STUDIO_MINUTES", "0"))
    chance = random.Random(8)
    for tab in ("panel", "relief", "lines", "model"):
        carver.goes_to(tab)
    heap, card = carver.sees(HEAP), carver.sees(CARD)
    end, count = time.monotonic() + 60 * minutes, 0
    while count < 60 or time.monotonic() < end:
        chance.choice(ACTS)(carver, chance)
        count += 1
        if count % 200 == 0:
            carver.calm()
            print(f"{count} events, heap {carver.sees(HEAP):.1f} MB, card {carver.sees(CARD)}")
    carver.calm()
    assert carver.page.inner_text("#messages") == ""
    for tab in ("panel", "relief", "lines", "model"):
        carver.goes_to(tab)
    print(f"{count} events; heap {heap:.1f} to {carver.sees(HEAP):.1f} MB, card {card} to {carver.sees(CARD)} objects")
    assert carver.sees(HEAP) < heap + 30
    assert carver.sees(CARD) <= card + 4
    shown_is_asked(carver)


@pytest.mark.parametrize("hurry", [0.0, 0.4])
def test_two_pages_of_one_studio_both_come_to_rest(carver, browser, studio, hurry):
    other = browser.new_context().new_page()
    other.goto(studio.url)
    carver.goes_to("relief")
    other.wait_for_selector("#tab-relief:enabled")
    other.click("#tab-relief")
    for depth in (2, 2.5, 3.5):
        carver.sees(f"studio.store.change({{depth: '{depth}mm'}})")
        carver.page.wait_for_timeout(1000 * hurry)
    carver.calm()
    assert abs(carver.heights().min() + 3.5) < 1e-3
    other.context.close()
