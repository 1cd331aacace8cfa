// All settings: the first group open, the others folded away.

import { byId, el } from "./dom.js";
import { field } from "./fields.js";

export class Controls {
  /**
   * @param {Store} store
   * @param {function} send  (setting, file): have a file's name for a setting
   */
  constructor(store, send) {
    Object.assign(this, { store, send, fields: new Map(), groups: new Map() });
    this.host = byId("fields");
    this.host.addEventListener("submit", (event) => event.preventDefault());
    store.listen((names) => this.#follow(names));
  }

  /** Lay out what the studio says can be set. */
  load(controls) {
    const parts = [...grouped(controls)].map(([name, members], at) => {
      const why = el("p", { class: "why", id: `why-${at}`, hidden: true });
      const made = members.map((control) => this.#field(control));
      this.groups.set(name, { why, names: members.map((control) => control.name) });
      if (at === 0) return el("section", { class: "first", "aria-label": name }, el("h2", {}, name), why, ...made);
      return el("details", {}, el("summary", {}, name), why, ...made);
    });
    this.host.replaceChildren(...parts);
    this.#follow(Object.keys(this.store.settings));
  }

  /** Tell what settings left empty came to. */
  tell(workedOut = {}) {
    for (const [name, text] of Object.entries(workedOut)) this.fields.get(name)?.tell(text);
  }

  /** Let rest what has nothing to say of this model, and tell why. */
  rest(idle = {}) {
    for (const { why, names } of this.groups.values()) {
      const reasons = new Set(names.map((name) => idle[name]).filter(Boolean));
      why.textContent = [...reasons].join(" ");
      why.hidden = reasons.size === 0;
      for (const name of names) this.fields.get(name).rest(idle[name] ? why.id : null, idle[name]);
    }
  }

  /** Show a fault at the setting it is of, if it is of one. */
  blame(error) {
    for (const each of this.fields.values()) each.blame("");
    const found = this.fields.get(error?.setting);
    found?.blame([error.message, error.expected && `expected: ${error.expected}`].filter(Boolean).join("; "));
    found?.element.closest("details")?.setAttribute("open", "");
  }

  #field(control) {
    const change = (text, held) => {
      this.store.change({ [control.name]: text }, `set ${control.name}`);
      if (!held) this.store.settle();
    };
    const made = field(control, change, (file) => this.send(control.name, file));
    this.fields.set(control.name, made);
    return made.element;
  }

  #follow(names) {
    for (const name of names) this.fields.get(name)?.set(this.store.settings[name] ?? "");
  }
}

function grouped(controls) {
  const groups = new Map();
  for (const control of controls) groups.set(control.group, [...(groups.get(control.group) ?? []), control]);
  return groups;
}
