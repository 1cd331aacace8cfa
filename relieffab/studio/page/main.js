// The page begins here: what the studio holds, then whatever the person does.

import { getFrame, getJson, postMask, postModel, StudioError } from "./api.js";
import { Asking } from "./asking.js";
import { Controls } from "./controls.js";
import { byId, isTyping } from "./dom.js";
import { listen } from "./events.js";
import { Exporting } from "./exporting.js";
import { account, complain, progress, say, settle } from "./messages.js";
import { carvingTime, Show, TABS } from "./show.js";
import { Store } from "./store.js";
import { Tabs } from "./tabs.js";
import { tooLarge, watchForModels } from "./upload.js";

const WARMING = "Getting ready: the first time on a machine this takes some minutes";

const FIRST = { mesh: "Model", svg: "Drawing" }; // what the first tab is called; else a picture

const store = new Store();
const controls = new Controls(store, sendMask);
const show = new Show(store, (seconds) => asking.carved(seconds));
const asking = new Asking({
  store,
  show,
  well(what, frame) {
    settle(what);
    controls.blame(null);
    if (frame.worked_out) controls.tell(frame.worked_out);
    if (frame.idle) controls.rest(frame.idle);
    const notes = [...new Set([...(model?.notes ?? []), ...(frame.notes ?? []), ...(frame.warnings ?? [])])];
    if (what === "toolpaths") notes.unshift(carvingTime(frame));
    account(frame.seconds, notes);
  },
  fail(error, what) {
    complain(error, what);
    controls.blame(error);
  },
});
const exporting = new Exporting(() => store.settings);
const tabs = new Tabs(TABS, (name) => {
  asking.want(show.choose(name));
});
let model = null;

store.listen(() => {
  byId("undo").disabled = !store.canUndo;
  byId("redo").disabled = !store.canRedo;
  // What was said of other settings, and is not asked again now, is no longer so.
  for (const what of ["panel", "toolpaths"]) if (!asking.wanted.includes(what)) settle(what);
  asking.refresh();
});

/** Take what the studio holds: at the beginning, and after another model. */
async function take(state) {
  model = state.model;
  byId("model-name").textContent = model?.name ?? "Open a model";
  byId("welcome").hidden = model !== null;
  exporting.enable(model !== null);
  tabs.enable(model !== null);
  document.title = model ? `${model.name} – relieffab studio` : "relieffab studio";
  if (!model) return;
  asking.forget();
  show.load(await getFrame("mesh"), model);
  controls.rest(model.idle);
  const { up, image, image_depth, mask } = state.settings;
  store.adopt({ up, image, image_depth, mask });
  tabs.rename("model", FIRST[model.kind] ?? "Picture");
  asking.want(show.choose(show.name));
  asking.begin();
  say([`${model.name}: ${model.about}`, ...(model.notes ?? [])].join(" · "));
}

/** Take a file as the mask of the picture that is open. */
async function sendMask(setting, file) {
  settle(setting);
  say(`Reading ${file.name} …`);
  try {
    const refused = tooLarge(file, limit);
    if (refused) throw new StudioError(refused);
    store.change(await postMask(file));
    store.settle();
    say("");
  } catch (error) {
    say("");
    complain(error, setting);
  }
}

/** Open a model: a file, or the studio's own of that name. */
async function open(name, file = null) {
  settle("model");
  say(`Reading ${name} …`);
  try {
    const refused = file && tooLarge(file, limit);
    if (refused) throw new StudioError(refused);
    await take(await postModel(name, file));
  } catch (error) {
    say("");
    complain(error, "model");
  }
}

let limit = null;

async function begin() {
  tabs.choose("model");
  tabs.enable(false);
  try {
    const state = await getJson("state");
    limit = state.limit_bytes;
    store.load(state.settings);
    controls.load(state.controls);
    exporting.show(state.export);
    if (state.warming) say(WARMING);
    listen({
      export: (told) => exporting.show(told),
      toolpaths: (told) => progress("Toolpaths", told),
      warm: (told) => (told ? progress("Getting ready", told) : account()),
    });
    await take(state);
  } catch (error) {
    complain(error, "studio");
  }
}

watchForModels((file) => open(file.name, file));
byId("scarab").addEventListener("click", () => open("scarab"));
byId("undo").addEventListener("click", () => store.undo());
byId("redo").addEventListener("click", () => store.redo());
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.altKey || isTyping(event)) return;
  const key = event.key.toLowerCase();
  if (key === "z" && event.shiftKey) store.redo();
  else if (key === "z") store.undo();
  else if (key === "y") store.redo();
  else return;
  event.preventDefault();
});

// What watches the page from outside, a test say, reads it here.
globalThis.studio = { store, show, asking };
begin();
