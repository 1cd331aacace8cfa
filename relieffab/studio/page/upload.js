// A model from this machine: dropped anywhere, or chosen.

import { byId } from "./dom.js";

/** @param {function} take  called with a File */
export function watchForModels(take) {
  const file = byId("file");
  const drop = byId("drop");
  for (const id of ["open", "choose"]) byId(id).addEventListener("click", () => file.click());
  file.addEventListener("change", () => {
    if (file.files.length > 0) take(file.files[0]);
    file.value = ""; // the same file can be chosen again
  });
  let depth = 0; // of elements that the pointer has entered
  const carriesFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragenter", (event) => {
    if (!carriesFiles(event)) return;
    depth += 1;
    drop.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (!carriesFiles(event)) return;
    depth = Math.max(0, depth - 1);
    drop.hidden = depth === 0;
  });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    depth = 0;
    drop.hidden = true;
    const [dropped] = event.dataTransfer?.files ?? [];
    if (dropped) take(dropped);
  });
}

/** Say that a file is too large before any of it is sent; null if it is not. */
export function tooLarge(file, limit) {
  if (!limit || file.size <= limit) return null;
  const megabytes = (bytes) => `${Math.round(bytes / 2 ** 20)} MB`;
  return {
    message: "The model's file is too large",
    expected: `at most ${megabytes(limit)}`,
    found: megabytes(file.size),
    where: file.name,
    hint: "a smaller one: fewer triangles, or fewer pixels",
  };
}
