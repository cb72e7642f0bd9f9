// shader_checks.js: checks of the newest texts by a worker, which has one request at a time. Newer texts end a search for mistakes; a check without
// one is short, and they wait for it for a while.
import { openCheck } from './check_start.js';

export const ENDLESS_MS = 30000, PATIENCE_MS = 1500;

const LATE = 'late';

export class Checks {
  #worker = null;
  #lists = null; // a promise: contracts, scenes, mistakes, exercises; the worker can be asked when it is there
  #round = 0; // of the newest texts
  #busy = null; // the request that the worker has: {searching, done: a promise, end(answer)}

  #restart() {
    this.#worker?.end();
    this.#busy?.end(null);
    const worker = (this.#worker = openCheck());
    this.#lists = worker.call('start', {});
    this.#lists.catch(() => {
      if (this.#worker === worker) this.close();
    });
  }

  // Ends the worker; the next call starts another one.
  close() {
    this.#worker?.end();
    this.#busy?.end(null);
    this.#worker = this.#lists = null;
  }

  #started() {
    if (!this.#worker) this.#restart();
    return this.#lists;
  }

  lists() {
    return this.#started();
  }

  // The texts of an exercise; reports of older texts are shown no more. Null: another text has come in between.
  async exercise(mistake) {
    const mine = ++this.#round;
    await this.#free();
    await this.#started();
    return mine === this.#round ? this.#worker.call('exercise', { mistake }) : null;
  }

  // The worker's answer; LATE where there is none in time, and another worker then stands ready; null where newer texts have ended it.
  async #request(asked, searching) {
    const worker = this.#worker, request = { searching };
    const answer = new Promise((resolve, reject) => {
      request.end = resolve;
      worker.call('check', asked).then(resolve, reject);
    });
    const timer = setTimeout(() => request.end(LATE), ENDLESS_MS);
    request.done = answer.then(() => {}, () => {});
    this.#busy = request;
    try {
      const found = await answer;
      if (found === LATE && this.#worker === worker) this.#restart();
      return found;
    } finally {
      clearTimeout(timer);
      if (this.#busy === request) this.#busy = null;
    }
  }

  // Ends what the worker does for older texts, or waits for its end where that is near.
  async #free() {
    const request = this.#busy;
    if (!request) return;
    let timer = 0;
    const patience = new Promise((resolve) => (timer = setTimeout(resolve, PATIENCE_MS)));
    if (!request.searching) await Promise.race([request.done, patience]);
    clearTimeout(timer);
    if (this.#busy === request) this.#restart();
  }

  // Calls `show` with the report of the texts: at once with pictures and verdict, and where they differ again with the mistakes. `searched`: there is
  // nothing to come; `cut`: the search did not end in time, and the report is that without it. Older texts are shown no more, nor are their errors.
  async run(asked, show) {
    const mine = ++this.#round, newest = () => mine === this.#round;
    try {
      await this.#free();
      await this.#started();
      if (!newest()) return;
      const quick = await this.#request({ ...asked, pictures: 1 }, false);
      if (!quick || !newest()) return;
      if (quick === LATE) return show({ verdict: 'endless', mistakes: [], notes: [], scenes: [], searched: true });
      show({ ...quick, searched: quick.verdict !== 'differs' });
      if (quick.verdict !== 'differs') return;
      const whole = await this.#request({ ...asked, pictures: 0 }, true);
      if (!whole || !newest()) return;
      show(whole === LATE || whole.verdict === 'endless' ? { ...quick, searched: true, cut: true } : { ...whole, searched: true });
    } catch (error) {
      if (newest()) throw error;
    }
  }
}
