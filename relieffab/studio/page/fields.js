// One setting on the page: a slider that can also be typed, a choice, a file, or a text.

import { el } from "./dom.js";
import { quantity, rounded } from "./quantity.js";

/**
 * Make the field of a control.
 *
 * @param {object} control  as the studio describes it
 * @param {function} change  (text, whether the hand still holds it)
 * @param {function} send  (file), of a setting that names one
 * @returns {{name, element, set, tell, blame, rest}}
 */
export function field(control, change, send) {
  const make = { range: slider, choice, file: fileField }[control.kind] ?? words;
  const made = make(control, change, send);
  const parts = frameOf(control, made, change);
  return {
    name: control.name,
    element: parts.element,
    set(text) {
      made.set(text);
      parts.reset.hidden = text === control.default;
    },
    /** Let it rest, for a reason that stands in an element of that id; null lets it work. */
    rest(reason, words) {
      parts.element.classList.toggle("idle", reason !== null);
      if (reason) parts.element.title = words;
      else parts.element.removeAttribute("title");
      for (const part of parts.element.querySelectorAll("input, select, button"))
        part.disabled = reason !== null;
      made.input.setAttribute("aria-describedby", [...parts.about, reason].filter(Boolean).join(" "));
    },
    /** Tell what a setting left empty came to. */
    tell: made.tell ?? (() => {}),
    /** Say what is wrong with it, or, with an empty text, that nothing is. */
    blame(message) {
      parts.fault.textContent = message;
      parts.element.classList.toggle("wrong", message !== "");
      made.input.setAttribute("aria-invalid", message !== "");
    },
  };
}

function frameOf(control, { input, before = null, after = null }, change) {
  const id = `set-${control.name}`;
  input.id = id;
  input.name = control.name;
  const about = [`${id}-help`, `${id}-fault`];
  input.setAttribute("aria-describedby", about.join(" "));
  const none = control.kind === "file" ? "None" : "Worked out by itself";
  const auto = control.default === "" ? none : `Back to ${control.default}`;
  const reset = el(
    "button",
    {
      type: "button",
      class: "reset",
      title: auto,
      "aria-label": `${control.label}: ${auto.toLowerCase()}`,
      hidden: true,
      onclick: () => {
        change(control.default, false);
        input.focus();
      },
    },
    "↺",
  );
  const fault = el("p", { class: "fault", id: `${id}-fault` });
  const element = el(
    "div",
    { class: `field ${control.kind}`, "data-name": control.name },
    el("label", { for: id, title: control.help ?? false }, control.label),
    reset,
    before,
    input,
    after,
    el("span", { class: "spoken", id: `${id}-help` }, control.help ?? ""),
    fault,
  );
  return { element, reset, fault, about };
}

function slider(control, change) {
  const { min, max, step, unit } = control;
  const input = el("input", { type: "text", inputmode: "decimal", class: "value", spellcheck: "false" });
  const dir = control.reverse ? "rtl" : "ltr";
  const range = el("input", { type: "range", min, max, step, dir, "aria-label": `${control.label}, slider` });
  const place = (text) => {
    range.value = quantity(text, unit) ?? Math.max(min, 0);
    range.setAttribute("aria-valuetext", text === "" ? "worked out by itself" : text);
    range.style.setProperty("--share", `${(100 * (range.value - min)) / (max - min)}%`);
  };
  range.addEventListener("input", () => change(rounded(Number(range.value), step) + unit, true));
  range.addEventListener("change", () => change(rounded(Number(range.value), step) + unit, false));
  input.addEventListener("change", () => change(input.value.trim(), false));
  let told = "";
  const set = (text) => {
    input.value = text;
    place(text || told);
    range.classList.toggle("auto", quantity(text, unit) === null);
  };
  const tell = (text) => {
    told = text ?? "";
    input.placeholder = told ? `auto ${told}` : "auto";
    if (input.value === "") set("");
  };
  if (control.default === "") tell("");
  return { input, after: range, set, tell };
}

function choice(control, change) {
  const options = control.choices.map((each) => {
    const [value, label] = typeof each === "string" ? [each, each] : [each.value, each.label];
    return el("option", { value }, label || "auto");
  });
  const input = el("select", {}, ...options);
  input.addEventListener("change", () => change(input.value, false));
  const empty = options.find((option) => option.value === "");
  const tell = (text) => empty && (empty.textContent = text ? `auto: ${text}` : "auto");
  const set = (text) => {
    if (![...input.options].some((option) => option.value === text))
      input.append(el("option", { value: text }, text || "auto"));
    input.value = text;
  };
  return { input, set, tell };
}

function fileField(_control, _change, send) {
  const chosen = el("input", { type: "file", hidden: true });
  const input = el("button", { type: "button", class: "quiet edge", onclick: () => chosen.click() });
  chosen.addEventListener("change", () => {
    if (chosen.files.length > 0) send(chosen.files[0]);
    chosen.value = ""; // the same file can be chosen again
  });
  return { input, after: chosen, set: (text) => (input.textContent = text || "Choose a file") };
}

function words(control, change) {
  const input = el("input", {
    type: "text",
    spellcheck: "false",
    placeholder: control.default === "" ? "none" : control.default,
  });
  input.addEventListener("change", () => change(input.value.trim(), false));
  return {
    input,
    set: (text) => (input.value = text),
    tell: (text) => (input.placeholder = text ? `auto ${text}` : input.placeholder),
  };
}
