// The settings as they are typed, and the way back.

const LONGEST = 200;

export class Store {
  #listeners = [];
  #past = [];
  #future = [];
  #gesture = null;

  constructor() {
    this.settings = {};
    this.version = 0;
  }

  /** Call back on every change, with the names that changed. */
  listen(listener) {
    this.#listeners.push(listener);
  }

  /** Begin anew with what the studio holds; nothing to undo. */
  load(settings) {
    this.#past = [];
    this.#future = [];
    this.#gesture = null;
    this.#apply({ ...settings });
  }

  /**
   * Change settings.
   *
   * @param {object} changes  texts by name
   * @param {string} gesture  changes of one gesture are undone at once
   */
  change(changes, gesture = null) {
    const names = Object.keys(changes).filter((name) => this.settings[name] !== changes[name]);
    if (names.length === 0) return;
    if (gesture === null || gesture !== this.#gesture) {
      this.#past.push(this.settings);
      if (this.#past.length > LONGEST) this.#past.shift();
    }
    this.#gesture = gesture;
    this.#future = [];
    this.#apply({ ...this.settings, ...changes });
  }

  /** End a gesture: the next change is a step of its own. */
  settle() {
    this.#gesture = null;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  undo() {
    this.#travel(this.#past, this.#future);
  }

  redo() {
    this.#travel(this.#future, this.#past);
  }

  /** Take what came with another model: no step of the person's, so none that undo brings back. */
  adopt(settings) {
    for (const steps of [this.#past, this.#future])
      steps.forEach((step, at) => (steps[at] = { ...step, ...settings }));
    this.#apply({ ...this.settings, ...settings });
  }

  #travel(from, to) {
    if (from.length === 0) return;
    this.#gesture = null;
    to.push(this.settings);
    this.#apply(from.pop());
  }

  #apply(settings) {
    const before = this.settings;
    this.settings = settings;
    this.version += 1;
    const names = new Set([...Object.keys(before), ...Object.keys(settings)]);
    const changed = [...names].filter((name) => before[name] !== settings[name]);
    for (const listener of this.#listeners) listener(changed);
  }
}
