// The programs' time: a scrubber, and a button that lets it run.

import { byId, el } from "./dom.js";
import { clock } from "./quantity.js";
import { PASSES } from "./views/toolpaths.js";

const RUN_S = 40; // how long the whole carving takes to see

export class Player {
  /**
   * @param {function} seek  (seconds): go there
   * @param {function} toggle  (kind's number, shown)
   */
  constructor(seek, toggle) {
    Object.assign(this, { seek, toggle, running: null, total: 0 });
    this.play = el(
      "button",
      { type: "button", class: "quiet edge play", onclick: () => this.#run(!this.running) },
      "Play",
    );
    this.scrub = el("input", {
      type: "range",
      min: 0,
      step: "any",
      id: "scrub",
      "aria-label": "Moment of the carving",
    });
    this.time = el("output", { for: "scrub" });
    this.legend = el("div", { class: "legend", role: "group", "aria-label": "Passes shown" });
    this.programs = el("p", { class: "programs" });
    this.element = el(
      "div",
      { class: "player" },
      this.play,
      this.scrub,
      this.time,
      this.legend,
      this.programs,
    );
    this.scrub.addEventListener("input", () => {
      this.#run(false);
      this.#go(Number(this.scrub.value));
    });
    this.scrub.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Take other programs, all carved. */
  load({ arrays, kinds, programs, seconds_total: total }) {
    this.#run(false);
    this.total = total;
    this.scrub.max = total;
    const present = new Set(arrays.kinds.data);
    const passes = kinds.map((kind, at) => present.has(at) && this.#pass(kind, at));
    this.legend.replaceChildren(...passes.filter(Boolean));
    this.programs.textContent = programs
      .map(({ name, file, cutter, seconds }) => `${file ?? name}: ${cutter}, ${clock(seconds)}`)
      .join(" · ");
    this.#go(total);
  }

  stop() {
    this.#run(false);
  }

  #pass(kind, at) {
    const chip = el("i");
    chip.style.background = PASSES[kind] ?? "#777777";
    const box = el("input", { type: "checkbox", onchange: () => this.toggle(at, box.checked) });
    box.checked = kind !== "rapid";
    return el("label", {}, box, chip, kind);
  }

  #go(seconds) {
    this.scrub.value = seconds;
    this.scrub.setAttribute("aria-valuetext", `${clock(seconds)} of ${clock(this.total)}`);
    this.scrub.style.setProperty("--share", `${this.total > 0 ? (100 * seconds) / this.total : 0}%`);
    this.time.textContent = `${clock(seconds)} of ${clock(this.total)}`;
    this.seek(seconds);
  }

  /** A hundredth of the whole a key press: `any` has no step of its own. */
  #key(event) {
    const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: 10, PageDown: -10 }[
      event.key
    ];
    if (step === undefined) return;
    event.preventDefault();
    this.#run(false);
    this.#go(Math.min(this.total, Math.max(0, Number(this.scrub.value) + (step * this.total) / 100)));
  }

  #run(on) {
    this.play.textContent = on ? "Pause" : "Play";
    cancelAnimationFrame(this.running);
    this.running = null;
    if (!on) return;
    if (Number(this.scrub.value) >= this.total) this.#go(0);
    let last = performance.now();
    const step = (now) => {
      const next = Number(this.scrub.value) + ((now - last) / 1000 / RUN_S) * this.total;
      last = now;
      this.running = requestAnimationFrame(step);
      this.#go(Math.min(next, this.total));
      if (next >= this.total) this.#run(false);
    };
    this.running = requestAnimationFrame(step);
  }
}

/** The tray of the player, beside others. */
export function showTray(element) {
  const tray = byId("tray");
  if (element === null) tray.replaceChildren();
  else if (tray.firstChild !== element) tray.replaceChildren(element);
}
