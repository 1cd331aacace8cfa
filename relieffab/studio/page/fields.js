// One setting on the page: a slider that can also be typed, a choice, or a text.

import { el } from "./dom.js";
import { quantity, rounded } from "./quantity.js";

/**
 * Make the field of a control.
 *
 * @param {object} control  as the studio describes it
 * @param {function} change  (text, whether the hand still holds it)
 * @returns {{name, element, set, tell, blame}}
 */
export function field(control, change) {
  const make = { range: slider, choice: choice }[control.kind] ?? words;
  const made = make(control, change);
  const parts = frameOf(control, made, change);
  return {
    name: control.name,
    element: parts.element,
    set(text) {
      made.set(text);
      parts.reset.hidden = text === control.default;
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
  input.setAttribute("aria-describedby", `${id}-help ${id}-fault`);
  const auto = control.default === "" ? "Worked out by itself" : `Back to ${control.default}`;
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
  return { element, reset, fault };
}

function slider(control, change) {
  const { min, max, step, unit } = control;
  const input = el("input", { type: "text", inputmode: "decimal", class: "value", spellcheck: "false" });
  const dir = control.reverse ? "rtl" : "ltr";
  const range = el("input", { type: "range", min, max, step, dir, "aria-label": `${control.label}, slider` });
  const place = (text) => {
    const value = quantity(text, unit);
    range.value = value ?? min;
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
    range.classList.toggle("auto", text === "");
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
  const set = (text) => {
    if (![...input.options].some((option) => option.value === text))
      input.append(el("option", { value: text }, text || "auto"));
    input.value = text;
  };
  return { input, set };
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
