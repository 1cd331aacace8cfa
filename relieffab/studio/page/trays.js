// What stands below the view: named views under a mesh, what a picture was taken for under
// a picture, a legend under the deviation.

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

const SHOWN = {
  photo: "a photograph",
  drawing: "a drawing",
  depth: "a depth map",
  "depth-white-far": "a depth map, white far away",
  normal: "a normal map",
  "normal-y-down": "a normal map, green downwards",
};

const BY = { background: ", by its background", data: ", by how it curls", custom: ", as is usual" };

/** What a picture was taken for, and by what. */
export class PictureTray {
  constructor() {
    this.element = el("p", { class: "facts" });
  }

  load({ kind, kind_by: by, mask, near, near_by: nearBy, green, green_by: greenBy }) {
    const facts = [
      SHOWN[kind] && `Taken for ${SHOWN[kind]}${by === "values" ? ", by its values" : ""}`,
      mask && `its figure found by ${mask}`,
      near && `${near} is near${BY[nearBy] ?? ""}`,
      green && `green points ${green === "y-down" ? "down" : "up"}${BY[greenBy] ?? ""}`,
    ];
    this.element.textContent = facts.filter(Boolean).join("; ");
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
