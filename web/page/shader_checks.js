// shader_checks.js: checks the newest shader texts in a worker, one request at a time. Newer texts end a search for mistakes. A check without a search is
// short, so newer texts wait for it.
import { openCheck } from './check_start.js';

export const ENDLESS_MS = 30000, PATIENCE_MS = 1500;

const LATE = 'late';

export class Checks {
  #worker = null;
  #lists = null; // a promise: contracts, scenes, mistakes, exercises; afterwards the worker accepts requests
  #round = 0; // number of the newest texts
  #busy = null; // the worker's current request: {searching, done: a promise, end(answer)}

  #restart() {
    this.#worker?.end();
    this.#busy?.end(null);
    const worker = (this.#worker = openCheck());
    this.#lists = worker.call('start', {});
    this.#lists.catch(() => {
      if (this.#worker === worker) this.close();
    });
  }

  // Ends the worker. The next call starts a new one.
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

  // The texts of an exercise. Reports about older texts are no longer shown. Null: other texts were chosen in the meantime.
  async exercise(mistake) {
    const mine = ++this.#round;
    await this.#free();
    await this.#started();
    return mine === this.#round ? this.#worker.call('exercise', { mistake }) : null;
  }

  // The worker's answer; LATE if it did not come in time, and a new worker is ready; null if newer texts have ended it.
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

  // Ends a request about older texts, or waits for it if it is almost finished.
  async #free() {
    const request = this.#busy;
    if (!request) return;
    let timer = 0;
    const patience = new Promise((resolve) => (timer = setTimeout(resolve, PATIENCE_MS)));
    if (!request.searching) await Promise.race([request.done, patience]);
    clearTimeout(timer);
    if (this.#busy === request) this.#restart();
  }

  // Calls `show` with the report: first pictures and verdict, and if they differ, a second time with the mistakes. `searched`: the report is final; `cut`: the
  // search did not end in time, so the report is without mistakes. Reports and errors about older texts are not shown.
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
