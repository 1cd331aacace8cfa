// At most one question in flight; of those that wait, the newest alone.

import { Superseded } from "./api.js";

const AGAIN_MS = 300; // and up to as much more, lest two pages push each other out for ever

export class Newest {
  /**
   * @param {function} send  question -> promise of its answer
   * @param {function} show  (answer, question), never for an older question than one shown
   * @param {function} fail  (error, question)
   * @param {function} busy  (whether anything is asked)
   * @param {function} again  (question): whether to ask it anew where the studio dropped it
   * @param {function} yields  (question): whether it gives way to a newer one in flight, too
   */
  constructor({ send, show, fail, busy = () => {}, again = () => true, yields = () => false }) {
    Object.assign(this, { send, show, fail, busy, again, yields, waiting: null, flight: null });
  }

  /** Ask, in place of what still waits. */
  ask(question) {
    this.waiting = { question };
    if (!this.flight || this.yields(this.flight.question)) this.#fly();
  }

  /** Forget what waits; what is in flight no longer matters either. */
  forget() {
    this.waiting = this.flight = null;
    this.busy(false);
  }

  async #fly() {
    const flight = (this.flight = this.waiting);
    this.waiting = null;
    this.busy(true);
    const [answer, error] = await this.send(flight.question).then(
      (given) => [given, null],
      (fault) => [null, fault],
    );
    if (error instanceof Superseded)
      await new Promise((resolve) => setTimeout(resolve, AGAIN_MS * (1 + Math.random())));
    if (this.flight !== flight) return; // forgotten, or it gave way
    try {
      this.#land(flight, answer, error);
    } finally {
      this.flight = null;
      if (this.waiting) this.#fly();
      else this.busy(false);
    }
  }

  #land({ question }, answer, error) {
    if (error === null) this.show(answer, question);
    else if (!(error instanceof Superseded)) this.fail(error, question);
    // Something more urgent came between.
    else if (this.again(question)) this.waiting ??= { question };
  }
}
