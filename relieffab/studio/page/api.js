// What the page asks of the studio, and how the studio refuses.

import { readFrame } from "./frame.js";

/** What the studio says when it cannot do what it was asked. */
export class StudioError extends Error {
  constructor({ message, expected, found, where, hint, setting }, status = 0) {
    super(message);
    Object.assign(this, { expected, found, where, hint, setting, status });
  }
}

/** An answer that never came, for a newer question was asked. */
export class Superseded extends Error {}

const AWAY = {
  message: "The studio does not answer",
  hint: "see whether `relieffab studio` still runs in its terminal, then load this page again",
};

async function ask(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw new StudioError(AWAY);
  }
  if (!response.ok) throw await refusal(response);
  return response;
}

async function refusal(response) {
  const said = await response.text();
  let told = {};
  try {
    told = JSON.parse(said);
  } catch {
    told = { error: { message: `The studio answers ${response.status}`, found: said.slice(0, 200) } };
  }
  if (told.superseded) return new Superseded();
  return new StudioError(told.error ?? { message: `The studio answers ${response.status}` }, response.status);
}

function json(body) {
  return { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
}

export async function getJson(path) {
  return (await ask(path)).json();
}

export async function postJson(path, body = {}) {
  return (await ask(path, json(body))).json();
}

export async function getFrame(path) {
  return readFrame(await (await ask(path)).arrayBuffer());
}

export async function postFrame(path, body) {
  return readFrame(await (await ask(path, json(body))).arrayBuffer());
}

/** Send a model as it is; without a file, ask for the studio's own of that name. */
export async function postModel(name, file = null) {
  return send("model", name, file);
}

/** Send a picture's mask; the answer names it. */
export async function postMask(file) {
  return send("mask", file.name, file);
}

async function send(what, name, file) {
  const path = `${what}?name=${encodeURIComponent(name)}`;
  return (await ask(path, { method: "POST", body: file ?? "" })).json();
}
