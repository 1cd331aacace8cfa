"""Somebody who presses everything: no fault, no growing memory, nothing stale."""

import os
import random
import time

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


def test_whatever_is_pressed_the_last_asked_is_the_last_shown(carver):
    minutes = float(os.environ.get("STUDIO_MINUTES", "0"))
    chance = random.Random(8)
    for tab in ("panel", "relief", "lines", "model"):
        carver.goes_to(tab)
    heap, card = carver.sees(HEAP), carver.sees(CARD)
    carver.sees("studio.asking.rest = 300")
    end, count = time.monotonic() + 60 * minutes, 0
    while count < 50 or time.monotonic() < end:
        chance.choice(ACTS)(carver, chance)
        count += 1
        if count % 200 == 0:
            carver.waits("document.getElementById('view').getAttribute('aria-busy') === 'false'")
            print(f"{count} events, heap {carver.sees(HEAP):.1f} MB, card {carver.sees(CARD)}")
    # A depth beyond the stock is refused, and said to be; whatever comes next settles it.
    carver.sees("studio.asking.rest = 1e8")
    carver.sees("studio.store.change({depth: '2.2mm'})")
    for tab in ("panel", "lines", "model", "relief"):
        carver.goes_to(tab)
    assert carver.page.inner_text("#messages") == ""
    assert carver.is_shown_what_it_asked()["depth_mm"] == 2.2
    after = carver.sees(HEAP), carver.sees(CARD)
    print(
        f"{count} events: heap {heap:.1f} to {after[0]:.1f} MB, card {card} to {after[1]} objects"
    )
    assert after[0] < heap + 30
    assert after[1] <= card + 4


def test_two_pages_of_one_studio_both_come_to_rest(carver, browser, studio):
    other = browser.new_context().new_page()
    other.goto(studio.url)
    carver.goes_to("relief")
    other.wait_for_selector("#tab-relief:enabled")
    other.click("#tab-relief")
    for depth in (2, 2.5, 3.5):
        carver.sees(f"studio.store.change({{depth: '{depth}mm'}})")
    carver.calm()
    assert carver.is_shown_what_it_asked()["depth_mm"] == 3.5
    other.context.close()
