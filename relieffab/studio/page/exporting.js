// The export: begun, watched, cancelled, and what it left.

import { postJson } from "./api.js";
import { byId, el } from "./dom.js";
import { complain, say, settle } from "./messages.js";

export class Exporting {
  /** @param {function} settings  () -> the settings as they stand */
  constructor(settings) {
    this.settings = settings;
    this.enabled = false;
    this.host = byId("exporting");
    this.button = byId("export");
    this.button.addEventListener("click", () => this.begin());
  }

  /** Whether there is anything to export. */
  enable(enabled) {
    this.enabled = enabled;
    this.button.disabled = !enabled || this.state === "running";
  }

  async begin() {
    settle("export");
    const before = this.told;
    say("Exporting");
    this.show({ state: "running" });
    this.host.focus();
    try {
      // The answer is not shown: events, which come in order, may have overtaken it.
      await postJson("export", { settings: this.settings() });
    } catch (error) {
      this.told = this.state = null;
      this.show(before);
      complain(error, "export");
    }
  }

  /** Show how an export stands. */
  show(told) {
    const before = this.state;
    this.told = told;
    this.state = told?.state;
    this.enable(this.enabled);
    if (!told || this.state === "cancelled") this.#none(before);
    else if (this.state === "running") this.#running(told);
    else if (this.state === "failed") this.#failed(told);
    else if (this.state === "done") this.#done(told, before);
  }

  #none(before) {
    this.host.hidden = true;
    this.bar = null;
    if (before === "running") {
      say("Cancelled; nothing is left behind");
      this.button.focus();
    }
  }

  #failed({ error }) {
    this.host.hidden = true;
    this.bar = null;
    complain(error, "export");
  }

  #running({ stage, done, total, unit }) {
    if (!this.bar) {
      this.bar = el("progress", { "aria-label": "Export" });
      this.line = el("p", { class: "stage-name" });
      const cancel = el(
        "button",
        { type: "button", class: "quiet edge", onclick: () => this.#cancel() },
        "Cancel",
      );
      this.#fill("Exporting", this.line, this.bar, cancel);
    }
    if (total > 0) {
      this.bar.max = total;
      this.bar.value = Math.min(done, total);
    } else this.bar.removeAttribute("value");
    this.line.textContent = [
      stage ?? "beginning",
      unit && total > 0 ? `${Math.round(done)} of ${Math.round(total)} ${unit}` : "",
    ]
      .filter(Boolean)
      .join(", ");
  }

  async #cancel() {
    try {
      await postJson("cancel");
    } catch (error) {
      complain(error, "export");
    }
  }

  #done({ folder, files, command }, before) {
    this.bar = null;
    const rows = files.map(({ name, bytes }) =>
      el(
        "li",
        {},
        el(
          "a",
          {
            href: `result/${name.split("/").map(encodeURIComponent).join("/")}`,
            download: name.split("/").at(-1),
          },
          name,
        ),
        el("span", {}, bytes === undefined ? "" : size(bytes)),
      ),
    );
    this.#fill(
      "Exported",
      el("p", { class: "stage-name" }, `into ${folder}`),
      el("ul", { class: "files" }, ...rows),
      command
        ? el(
            "p",
            {},
            "The command that makes this again, with ",
            el("a", { href: "job.toml", download: "job.toml" }, "its job file"),
            ":",
          )
        : null,
      command ? this.#command(command) : null,
    );
    if (before === "running") {
      say(`Exported ${files.length} files`);
      this.host.focus();
    }
  }

  #command(command) {
    const copy = el(
      "button",
      {
        type: "button",
        class: "quiet edge",
        onclick: async () => {
          await navigator.clipboard.writeText(command);
          copy.textContent = "Copied";
          setTimeout(() => (copy.textContent = "Copy"), 1500);
        },
      },
      "Copy",
    );
    return el("div", { class: "command" }, el("code", {}, command), copy);
  }

  #fill(title, ...parts) {
    const close = el(
      "button",
      { type: "button", class: "close", "aria-label": "Close", onclick: () => (this.host.hidden = true) },
      "×",
    );
    this.host.replaceChildren(
      el("h2", { id: "exporting-title" }, title),
      ...parts.filter(Boolean),
      ...(title === "Exported" ? [close] : []),
    );
    this.host.hidden = false;
  }
}

function size(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 1e6) return `${Math.round(bytes / 1000)} kB`;
  return `${(bytes / 1e6).toFixed(1)} MB`;
}
