// shader_checks.js: checks the newest shader texts in a worker, one request at a time. If the texts change during a search for mistakes, the search is ended. A
// check without a search is short, so newer texts wait until it has ended.
import { openCheck } from './check_start.js';

const ENDLESS_MS = 30000, PATIENCE_MS = 1500;

const LATE = 'late';

export class Checks {
  #worker = null;
  #lists = null; // a promise of the contracts, scenes, mistakes and exercises; once it is resolved, the worker accepts requests
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

  // Returns the texts of an exercise, or null if other texts were chosen in the meantime. Reports about older texts are no longer shown.
  async exercise(mistake) {
    const mine = ++this.#round;
    await this.#free();
    await this.#started();
    return mine === this.#round ? this.#worker.call('exercise', { mistake }) : null;
  }

  // Returns the worker's answer. If the answer does not arrive in time, starts a new worker and returns LATE. Returns null if newer texts have ended the
  // request.
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

  // Ends a request about older texts. If the request is without a search, first waits a short time for it to finish.
  async #free() {
    const request = this.#busy;
    if (!request) return;
    let timer = 0;
    const patience = new Promise((resolve) => (timer = setTimeout(resolve, PATIENCE_MS)));
    if (!request.searching) await Promise.race([request.done, patience]);
    clearTimeout(timer);
    if (this.#busy === request) this.#restart();
  }

  // Calls `show` with a report that contains the pictures and the verdict. If the pictures differ, calls it a second time with the mistakes. `searched` means
  // that the report is final. `cut` means that the search did not end in time, so the report contains no mistakes. Reports and errors about older texts are not
  // shown.
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
