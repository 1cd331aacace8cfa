// What the studio says: what went wrong, what it did, how long it took.

import { byId, el } from "./dom.js";

const TOLD = [
  ["expected", "expected"],
  ["found", "found"],
  ["where", "where"],
  ["hint", "try"],
];

/** Show what went wrong, as the studio says it; it stays until it is settled or closed. */
export function complain(error, about) {
  const facts = TOLD.filter(([key]) => error[key]).flatMap(([key, label]) => [
    el("dt", {}, label),
    el("dd", {}, String(error[key])),
  ]);
  const box = el(
    "div",
    { class: "message", "data-about": about },
    el("p", {}, error.message),
    facts.length > 0 ? el("dl", {}, ...facts) : null,
    el(
      "button",
      { type: "button", class: "close", "aria-label": "Close this message", onclick: () => box.remove() },
      "×",
    ),
  );
  settle(about);
  byId("messages").append(box);
  box.scrollIntoView?.({ block: "nearest" });
}

/** Take away what was said about something that is well again. */
export function settle(about) {
  for (const old of byId("messages").querySelectorAll(`[data-about="${about}"]`)) old.remove();
}

/** Say in one line what is the case now; read out to those who listen. */
export function say(text) {
  byId("status").textContent = text;
}

/** Say how far long work is, where only the eye follows. */
export function progress(what, { stage, done, total }) {
  const share = total > 0 ? `, ${Math.round((100 * done) / total)} %` : "";
  byId("times").textContent = `${what}: ${stage}${share}`;
}

/** Say how long each part took, and what was noted on the way. */
export function account(seconds = {}, notes = []) {
  const told = Object.entries(seconds).filter(([, value]) => value >= 0.001);
  const times = told.map(
    ([name, value]) => `${name} ${value < 1 ? `${Math.round(1000 * value)} ms` : `${value.toFixed(1)} s`}`,
  );
  byId("times").textContent = times.join(" · ");
  byId("status").textContent = notes.join(" · ");
}
