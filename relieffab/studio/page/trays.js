// What stands below the view: named views under the model, a legend under the deviation.

import { el } from "./dom.js";
import { anglesOf, VIEWS } from "./placement.js";
import { millimetres } from "./quantity.js";

/** The named views as buttons, and the angles as they stand. */
export class ViewTray {
  constructor(store) {
    this.store = store;
    this.buttons = Object.keys(VIEWS).map((name) =>
      el(
        "button",
        { type: "button", class: "quiet edge", "data-view": name, onclick: () => this.#look(name) },
        name,
      ),
    );
    this.angles = el("output", { class: "angles" });
    const named = el("div", { class: "named", role: "group", "aria-label": "Named views" }, ...this.buttons);
    this.element = el("div", { class: "views" }, named, this.angles);
    store.listen(() => this.follow());
  }

  follow() {
    const { settings } = this.store;
    const { azimuth, elevation, roll } = anglesOf(settings);
    const turned = Boolean(settings.azimuth || settings.elevation) || roll !== 0;
    for (const button of this.buttons)
      button.setAttribute("aria-pressed", !turned && button.dataset.view === settings.view);
    const degrees = (angle) => `${Number(angle.toFixed(1))}°`.replace("-", "−");
    this.angles.textContent = `azimuth ${degrees(azimuth)}, elevation ${degrees(elevation)}, roll ${degrees(roll)}`;
  }

  #look(name) {
    this.store.settle();
    this.store.change({ view: name, azimuth: "", elevation: "", roll: "0deg" });
  }
}

/** What the colours of the deviation mean, and the numbers behind them. */
export class DeviationTray {
  constructor() {
    this.scale = el("div", { class: "scale", "aria-hidden": "true" });
    this.low = el("span");
    this.high = el("span");
    this.facts = el("p", { class: "facts" });
    const ends = el("div", { class: "ends" }, this.low, el("span", {}, "as wanted"), this.high);
    this.element = el("div", { class: "deviation" }, this.scale, ends, this.facts);
  }

  load({ deviation_mm: { limit, gouge, excess_p99: excess } }) {
    this.low.textContent = `${millimetres(limit)} too deep`;
    this.high.textContent = `${millimetres(limit)} left`;
    const known = (value) => Number.isFinite(value);
    this.facts.textContent = [
      known(gouge) && `deepest gouge ${millimetres(gouge, 3)}`,
      known(excess) && `99 % of the figure within ${millimetres(excess, 3)}`,
    ]
      .filter(Boolean)
      .join(" · ");
  }
}
