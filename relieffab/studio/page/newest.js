// At most one question in flight; of those that wait, the newest alone.

import { Superseded } from "./api.js";

const AGAIN_MS = 300;

export class Newest {
  /**
   * @param {function} send  question -> promise of its answer
   * @param {function} show  (answer, question), never for an older question than one shown
   * @param {function} fail  (error, question)
   * @param {function} busy  (whether anything is asked)
   * @param {function} again  (question): whether to ask it anew where the studio dropped it
   */
  constructor({ send, show, fail, busy = () => {}, again = () => true }) {
    Object.assign(this, { send, show, fail, busy, again, waiting: null, running: false });
  }

  /** Ask, in place of what still waits. */
  ask(question) {
    this.waiting = { question };
    if (!this.running) this.#run();
  }

  /** Forget what waits: what is in flight no longer matters either. */
  forget() {
    this.waiting = null;
    this.flight = null;
  }

  async #run() {
    this.running = true;
    this.busy(true);
    try {
      while (this.waiting) await this.#one();
    } finally {
      this.running = false;
      this.busy(false);
    }
  }

  async #one() {
    const { question } = this.waiting;
    this.waiting = null;
    const flight = (this.flight = {});
    let answer;
    try {
      answer = await this.send(question);
    } catch (error) {
      if (error instanceof Superseded) await this.#askAgain(question);
      else if (this.flight === flight) this.fail(error, question);
      return;
    }
    if (this.flight === flight) this.show(answer, question);
  }

  /** Something more urgent came between: let that pass, then ask anew. */
  async #askAgain(question) {
    await new Promise((resolve) => setTimeout(resolve, AGAIN_MS));
    if (this.again(question)) this.waiting ??= { question };
  }
}
