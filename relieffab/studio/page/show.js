// The views, each with its tab and tray, and what goes from the studio into which.

import { byId } from "./dom.js";
import { clock, millimetres } from "./quantity.js";
import { lead } from "./hand.js";
import { Player, showTray } from "./player.js";
import { Stage } from "./stage.js";
import { Sun } from "./sun.js";
import { DeviationTray, PictureTray, ViewTray } from "./trays.js";
import { DeviationView } from "./views/deviation.js";
import { LayerView, LinesView } from "./views/layers.js";
import { ModelView } from "./views/model.js";
import { PanelView } from "./views/panel.js";
import { PictureView } from "./views/picture.js";
import { ReliefView } from "./views/relief.js";
import { ToolpathView } from "./views/toolpaths.js";

export const TABS = [
  { name: "model", label: "Model", group: 1 },
  { name: "lines", label: "Lines", group: 2 },
  { name: "lambert", label: "Lambert", group: 2 },
  { name: "depth", label: "Depth", group: 2 },
  { name: "relief", label: "Relief", group: 3 },
  { name: "panel", label: "Panel", group: 3 },
  { name: "toolpaths", label: "Toolpaths", group: 4 },
  { name: "deviation", label: "Deviation", group: 4 },
];

export class Show {
  /**
   * @param {Store} store
   * @param {function} carved  (seconds): ask for the stock of that moment
   */
  constructor(store, carved) {
    this.store = store;
    this.stage = new Stage(byId("view"), byId("canvas"));
    this.sun = new Sun(byId("sun"), (direction) => {
      this.stage.view?.relight?.(direction);
      this.stage.draw();
    });
    this.firsts = { mesh: new ModelView(store), picture: new PictureView() };
    this.views = {
      model: this.firsts.mesh,
      lines: new LinesView(),
      lambert: new LayerView("lambert"),
      depth: new LayerView("depth"),
      relief: new ReliefView(this.sun),
      panel: new PanelView(this.sun),
      toolpaths: new ToolpathView(this.sun),
      deviation: new DeviationView(),
    };
    for (const name of ["lines", "lambert", "depth"])
      this.views[name].told = (at) => readout(at && place(at));
    this.views.deviation.told = (at) => readout(at && `${place(at)}: ${deviation(at.value)}`);
    this.#trays(carved);
    lead(
      byId("view"),
      byId("canvas"),
      () => this.stage.view,
      (ended) => {
        if (ended) store.settle();
        this.stage.draw();
      },
    );
    store.listen(() => {
      this.views.model.place();
      this.stage.draw();
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.views.model.dress();
      this.stage.draw();
    });
  }

  /** Show the view of a tab; what it wants is the answer. */
  choose(name) {
    this.name = name;
    const view = this.views[name];
    this.stage.show(view);
    byId("sun").hidden = !view.lit;
    byId("view-help").textContent = view.help;
    readout(null);
    if (name !== "toolpaths") this.player.stop();
    showTray(this.trays[name] ?? null);
    return view.wants;
  }

  /** Take another model: a mesh, or a picture. */
  load(frame, model) {
    const kind = frame.picture ? "picture" : "mesh";
    this.views.model = this.firsts[kind];
    this.trays.model = this.before[kind];
    this.views.model.load(frame, model);
    this.stage.draw();
  }

  layers(frame, settings) {
    this.views.model.draw(frame, settings);
    this.pictured.load(frame.picture);
    for (const name of ["lines", "lambert", "depth"]) this.views[name].show(frame, settings);
    this.stage.draw();
  }

  relief(frame, settings) {
    this.views.relief.show(frame, settings);
    this.views.relief.slab.relight(this.views.relief.towards);
    this.stage.draw();
  }

  panel(frame, settings) {
    this.views.panel.show(frame, settings);
    this.stage.draw();
  }

  toolpaths(frame, settings) {
    this.views.toolpaths.show(frame, settings);
    this.views.deviation.show(frame, settings);
    this.trays.deviation.hidden = false;
    this.deviation.load(frame);
    this.player.load(frame);
    this.trays.toolpaths.hidden = false;
    this.stage.draw();
  }

  carved(frame) {
    this.views.toolpaths.carve(frame);
    this.stage.draw();
  }

  #trays(carved) {
    this.player = new Player(
      (seconds) => {
        this.views.toolpaths.seek(seconds);
        this.stage.draw();
        carved(seconds);
      },
      (kind, shown) => {
        this.views.toolpaths.toggle(kind, shown);
        this.stage.draw();
      },
    );
    this.deviation = new DeviationTray();
    this.pictured = new PictureTray();
    this.before = { mesh: new ViewTray(this.store).element, picture: this.pictured.element };
    this.trays = { model: this.before.mesh, toolpaths: this.player.element, deviation: this.deviation.element };
    this.trays.toolpaths.hidden = this.trays.deviation.hidden = true;
  }
}

function readout(text) {
  byId("readout").textContent = text ?? "";
}

function place({ x, y }) {
  return `x ${millimetres(x, 1)}, y ${millimetres(y, 1)}`;
}

function deviation(value) {
  if (!Number.isFinite(value)) return "off the figure";
  return `${millimetres(Math.abs(value), 3)} ${value < 0 ? "too deep" : "left standing"}`;
}

/** Say what a toolpath frame comes to, in one line. */
export function carvingTime({ seconds_total: total }) {
  return `carving takes ${clock(total)}`;
}
