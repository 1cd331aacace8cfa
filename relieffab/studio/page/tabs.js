// The switch between views: tabs with one stop for the keyboard, arrows between them.

import { byId, el } from "./dom.js";

export class Tabs {
  /**
   * @param {object[]} tabs  {name, label, group}; a gap goes between groups
   * @param {function} chosen  called with a name
   */
  constructor(tabs, chosen) {
    this.host = byId("tabs");
    this.panel = byId("view");
    this.chosen = chosen;
    this.buttons = tabs.map(({ name, label, group }, at) =>
      el(
        "button",
        {
          type: "button",
          role: "tab",
          id: `tab-${name}`,
          "data-name": name,
          "data-first": at > 0 && tabs[at - 1].group !== group,
          "aria-controls": "view",
          onclick: () => this.choose(name),
        },
        label,
      ),
    );
    this.host.append(...this.buttons);
    this.host.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Choose a tab and say so. */
  choose(name) {
    this.name = name;
    for (const button of this.buttons) {
      const own = button.dataset.name === name;
      button.setAttribute("aria-selected", own);
      button.tabIndex = own ? 0 : -1;
      if (own) button.scrollIntoView?.({ block: "nearest", inline: "nearest" });
    }
    this.panel.setAttribute("aria-labelledby", `tab-${name}`);
    this.chosen(name);
  }

  rename(name, label) {
    byId(`tab-${name}`).textContent = label;
  }

  enable(enabled) {
    for (const button of this.buttons) button.disabled = !enabled;
  }

  #key(event) {
    const at = this.buttons.indexOf(document.activeElement);
    const last = this.buttons.length - 1;
    const to = {
      ArrowRight: at === last ? 0 : at + 1,
      ArrowLeft: at === 0 ? last : at - 1,
      Home: 0,
      End: last,
    }[event.key];
    if (at < 0 || to === undefined) return;
    event.preventDefault();
    this.buttons[to].focus();
    this.choose(this.buttons[to].dataset.name);
  }
}
