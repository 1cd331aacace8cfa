"""Modules of the page that show nothing, each asked by itself."""

import base64

import numpy as np

from relieffab.picture import stone
from relieffab.studio.frames import pack
from relieffab.units import length, lengths


def test_frames_arrive_as_they_were_packed(person):
    arrays = {
        "heights": np.linspace(-3, 0, 35, dtype=np.float32).reshape(5, 7),
        "mask": np.arange(9, dtype=np.uint8).reshape(3, 3),
        "starts": np.array([0, 5, 70000], np.uint32),
    }
    body = base64.b64encode(pack({"ask": 7, "name": "Nofretetes Büste"}, arrays)).decode()
    read = person.page.evaluate(
        """async (text) => {
          const { readFrame } = await import('./page/frame.js');
          const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
          const { arrays, ask, name } = readFrame(bytes.buffer);
          const plain = ([name, { data, shape }]) => [name, shape, [...data]];
          return [ask, name, Object.entries(arrays).map(plain)];
        }""",
        body,
    )
    assert read[:2] == [7, "Nofretetes Büste"]
    assert {name: (tuple(shape), data) for name, shape, data in read[2]} == {
        name: (array.shape, array.ravel().tolist()) for name, array in arrays.items()
    }


def test_the_newest_question_is_answered_last_and_alone(person):
    shown, most = person.page.evaluate(
        """async () => {
          const { Newest } = await import('./page/newest.js');
          let [flying, most, shown] = [0, 0, []];
          const newest = new Newest({
            send: async (question) => {
              most = Math.max(most, ++flying);
              await new Promise((resolve) => setTimeout(resolve, 1 + ((question * 7) % 5)));
              flying -= 1;
              if (question % 4 === 3) throw new Error('no');
              return question;
            },
            show: (answer) => shown.push(answer),
            fail: () => {},
          });
          for (let question = 0; question < 200; question++) {
            newest.ask(question);
            if (question % 3 === 0) await new Promise((resolve) => setTimeout(resolve, 1));
          }
          newest.ask(200);
          while (newest.flight) await new Promise((resolve) => setTimeout(resolve, 1));
          return [shown, most];
        }"""
    )
    assert most == 1
    assert shown[-1] == 200
    assert shown == sorted(shown)
    assert 3 < len(shown) < 150


def test_what_gives_way_is_not_waited_for_and_not_shown(person):
    shown = person.page.evaluate(
        """async () => {
          const { Newest } = await import('./page/newest.js');
          const shown = [];
          const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
          const newest = new Newest({
            send: async ({ ms, name }) => (await pause(ms), name),
            show: (answer) => shown.push(answer),
            fail: () => {},
            yields: ({ fine }) => fine,
          });
          newest.ask({ name: 'fine', ms: 200, fine: true });
          await pause(5);
          newest.ask({ name: 'coarse', ms: 5 });
          await pause(60);
          shown.push('soon');
          await pause(250);
          return shown;
        }"""
    )
    assert shown == ["coarse", "soon"]


def test_undo_and_redo_go_the_same_way(person):
    states = person.page.evaluate(
        """async () => {
          const { Store } = await import('./page/store.js');
          const store = new Store();
          store.load({ depth: '3mm', roll: '0deg' });
          for (const depth of [4, 5, 6]) store.change({ depth: `${depth}mm` }, 'depth');
          store.settle();
          store.change({ roll: '5deg' });
          store.change({ roll: '5deg' });
          const seen = [store.settings];
          for (const way of ['undo', 'undo', 'undo', 'redo', 'redo', 'redo']) {
            store[way]();
            seen.push(store.settings);
          }
          // What came with another model stays, however far one goes back.
          store.adopt({ roll: '9deg' });
          for (let step = 0; step < 3; step++) store.undo();
          seen.push(store.settings);
          return seen.map(({ depth, roll }) => `${depth} ${roll}`);
        }"""
    )
    there = ["6mm 5deg", "6mm 0deg", "3mm 0deg", "3mm 0deg"]
    assert states == [*there, "6mm 0deg", "6mm 5deg", "6mm 5deg", "3mm 9deg"]


def test_quantities_are_read_as_the_studio_reads_them(person):
    texts = ["4mm", "0.25in", "1.2 cm", ".5", '1e1"', "40um", "2ft"]
    read = person.page.evaluate(
        "async (texts) => { const { quantity } = await import('./page/quantity.js');"
        " return texts.map((text) => quantity(text, 'mm')); }",
        [*texts, "4 elephants", "deep", ""],
    )
    assert np.allclose(read[:-3], [length(text) for text in texts])
    assert read[-3:] == [None, None, None]
    sizes = ["120x90mm", "8in x 4in", "10cm×90mm", "300 x 200"]  # noqa: RUF001
    pairs = person.page.evaluate(
        "async (texts) => { const { pair } = await import('./page/quantity.js');"
        " return texts.map(pair); }",
        sizes,
    )
    assert np.allclose(pairs, [lengths(text) for text in sizes])


def test_the_sky_over_a_relief_is_that_of_the_pictures(person):
    rows, cols, pitch = 40, 56, 0.3
    y, x = np.mgrid[:rows, :cols]
    bowl = -3 * np.exp(-((x - 30) ** 2 + (y - 18) ** 2) / 90) + 0.4 * np.sin(x / 3) * (x > 20)
    heights = np.minimum(bowl, 0).astype(np.float32)
    open_to = person.page.evaluate(
        """async ([heights, shape, pitch, light]) => {
          const { fieldOf, openToLight, openToSky } = await import('./page/openness.js');
          const field = fieldOf(Float32Array.from(heights), shape, pitch);
          const open = new Float32Array(2 * heights.length);
          openToSky(field, open);
          openToLight(field, light, open);
          return [...open];
        }""",
        [heights.ravel().tolist(), [rows, cols], pitch, {"x": -0.6, "y": 0.6, "z": 0.529}],
    )
    light, sky = np.array(open_to).reshape(rows, cols, 2).transpose(2, 0, 1)
    inside = np.s_[12:-12, 14:-14]
    assert np.allclose(sky[inside], stone.sky(heights, pitch)[inside], atol=0.02)
    lit = stone.lit(heights, pitch, np.array([-0.6, 0.6, 0.529]))
    assert np.abs(light - lit)[inside].mean() < 0.03
    assert light.min() == 0
