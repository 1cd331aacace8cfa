// What the views show, asked of the studio when it no longer fits the settings.

import { getFrame, postFrame } from "./api.js";
import { byId } from "./dom.js";
import { Newest } from "./newest.js";

// Of two pages that are open at once, each has questions of its own.
const PAGE = crypto.randomUUID();
const REST_MS = 400; // after which the hand is said to rest
const PATIENCE_MS = 250; // before a wait is shown

export class Asking {
  /**
   * @param {Store} store
   * @param {object} show  {layers, relief, panel, toolpaths, carved}: each (frame, settings)
   * @param {function} fail  (error, what was asked)
   * @param {function} well  (what was answered, frame)
   */
  constructor({ store, show, fail, well }) {
    Object.assign(this, {
      store,
      show,
      fail,
      well,
      wanted: [],
      count: 0,
      begun: false,
      rest: REST_MS,
      working: new Set(),
    });
    this.fresh = {}; // version of the settings that each product shown is of
    this.fine = {}; // the same, of what is shown as finely as it can be
    this.preview = this.#channel("preview", (question) => postFrame("preview", question));
    this.panel = this.#channel("panel", (question) => postFrame("panel", question));
    this.toolpaths = this.#channel("toolpaths", (question) => postFrame("toolpaths", question));
    this.stock = new Newest({
      send: (seconds) => getFrame(`carved?at=${seconds}`),
      show: (frame) => show.carved(frame),
      fail: (error) => fail(error, "carved"),
      busy: (busy) => this.#busy("carved", busy),
    });
  }

  /** Want these products from now on: ask for what is stale. */
  want(products) {
    this.wanted = products;
    this.refresh();
  }

  /** There is a model to ask about. */
  begin() {
    this.begun = true;
    this.refresh();
  }

  /** Ask for whatever is wanted and no longer fits. */
  refresh() {
    if (!this.begun) return;
    const { version } = this.store;
    const stale = this.wanted.filter((name) => this.fresh[name] !== version);
    const seen = stale.filter((name) => name === "layers" || name === "relief");
    if (seen.length > 0) this.#ask(this.preview, seen);
    if (stale.includes("panel")) this.#ask(this.panel, ["panel"]);
    if (stale.includes("toolpaths")) this.#ask(this.toolpaths, ["toolpaths"]);
    if (stale.length === 0) this.#tell();
    this.#restSoon();
  }

  /** Ask for finer pictures of what is shown, once the hand rests. */
  #restSoon() {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      const { version } = this.store;
      const coarse = this.wanted.filter(
        (name) => this.fresh[name] === version && this.fine[name] !== version,
      );
      const seen = coarse.filter((name) => name === "layers" || name === "relief");
      if (this.begun && seen.length > 0 && !this.preview.flight) this.#ask(this.preview, seen, true);
    }, this.rest);
  }

  /** Another model: nothing that was asked before matters. */
  forget() {
    this.begun = false;
    for (const channel of [this.preview, this.panel, this.toolpaths, this.stock]) channel.forget();
    this.fresh = {};
    this.fine = {};
  }

  /** See the stock at a moment. */
  carved(seconds) {
    this.stock.ask(seconds);
  }

  #ask(channel, want, fine = false) {
    const { settings, version } = this.store;
    this.count += 1;
    byId("view").dataset.asked = version;
    channel.ask({ ask: this.count, settings, want, version, fine });
  }

  #channel(name, send) {
    return new Newest({
      send: ({ ask, settings, want, fine }) => send({ page: PAGE, ask, settings, want, fine }),
      yields: ({ fine }) => fine,
      again: ({ want, version, fine }) =>
        !fine && version === this.store.version && want.some((product) => this.wanted.includes(product)),
      show: (frame, { want, settings, version, fine }) => {
        for (const product of want) {
          this.show[product](frame, settings);
          this.fresh[product] = version;
          if (fine) this.fine[product] = version;
        }
        this.well(name, frame);
        this.#tell();
        this.#restSoon();
      },
      fail: (error, { want, version }) => {
        // What cannot be made is not asked again until something changes.
        for (const product of want) this.fresh[product] = version;
        this.fail(error, name);
      },
      busy: (busy) => this.#busy(name, busy),
    });
  }

  /** Write down, for those who watch the page, of which settings what is shown is. */
  #tell() {
    const versions = this.wanted.map((name) => this.fresh[name] ?? 0);
    byId("view").dataset.shown = Math.min(...versions);
  }

  #busy(name, busy) {
    if (busy) this.working.add(name);
    else this.working.delete(name);
    const any = this.working.size > 0;
    byId("view").setAttribute("aria-busy", any);
    clearTimeout(this.timer);
    if (!any) byId("busy").hidden = true;
    else this.timer = setTimeout(() => (byId("busy").hidden = false), PATIENCE_MS);
  }
}
