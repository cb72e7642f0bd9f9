// caller.js: calls the functions of a worker that can be ended and restarted. A new worker receives the state of the previous worker.
import { text } from '../base/strings.js';

// Thrown if a call was ended because its answer is no longer needed.
export class Ended extends Error {}

// `open` starts the worker. `wasm` is its module. `ways` has a list of functions for each part of the module, by the part's name. Each function fetches the
// part's bytes, or the module with threads. The first function that succeeds is used. `ways` is empty if the module is undivided. `ways.helps` means that this
// worker does not draw the main picture.
export function caller(open, wasm, ways = {}) {
  const waiting = new Map(), fetched = new Map(), parted = Boolean(ways.more);
  let next = 0, worker = null, setup = [], ready = Promise.resolve(), cancel = null, onprogress = () => {};

  function start() {
    worker = open();
    cancel = null;
    worker.onmessage = ({ data }) => (data.id === undefined ? onprogress(data.progress) : answered(data));
    worker.onerror = (event) => {
      for (const { reject } of waiting.values()) reject(new Error(event.message || text('workerEnded')));
      waiting.clear();
    };
  }

  const send = (message) =>
    new Promise((resolve, reject) => {
      message.id = next++;
      waiting.set(message.id, { message, resolve, reject });
      worker.postMessage(message);
    });

  // Keeps the last message of each kind, so that a restarted worker can receive it again.
  function remember(message) {
    const key = message.call + (message.part ?? '');
    setup = [...setup.filter((one) => one.key !== key), { key, message }];
  }

  async function complete(part) {
    if (!ways[part]) throw new Error(text('workerEnded'));
    let failure = null;
    for (const way of ways[part]) {
      try {
        const message = { call: 'complete', part, ...(await way()) }, answer = await send(message);
        remember(message);
        completed(answer);
        return;
      } catch (error) {
        failure = error;
      }
    }
    throw failure;
  }

  function completed({ threads, shared, flag }) {
    if (!ways.helps) document.body.dataset.threads = threads;
    cancel = shared ? new Int32Array(shared, flag, 1) : cancel;
  }

  // Fetches a part once. After a failed attempt, the next call fetches it again.
  function fetchPart(part) {
    if (!fetched.has(part)) {
      fetched.set(part, complete(part).catch((error) => {
        fetched.delete(part);
        throw error;
      }));
    }
    return fetched.get(part);
  }

  function answered(data) {
    const { message, resolve, reject } = waiting.get(data.id);
    waiting.delete(data.id);
    if (data.missing) fetchPart(data.missing).then(() => send(message)).then(resolve, reject);
    else if (data.error === undefined) resolve(data.result);
    else if (data.cancelled && message.endable) reject(new Ended());
    else if (data.cancelled) send(message).then(resolve, reject); // the flag was set for another call
    else reject(Object.assign(new Error(data.error), { missing: data.missing_files ?? [] }));
  }

  // Ends the worker's current call by starting a new worker. Waiting calls are sent again.
  function restart() {
    const calls = [...waiting.values()], running = calls.find(({ message }) => message.endable);
    const others = calls.filter((one) => one !== running);
    waiting.clear();
    worker.terminate();
    running?.reject(new Ended());
    start();
    ready = setup.reduce((before, { message }) => before.then(async () => {
      const answer = await send({ ...message });
      if (message.call === 'complete') completed(answer);
    }), Promise.resolve());
    ready.then(() => others.forEach(({ message, resolve, reject }) => send(message).then(resolve, reject)), () => {});
  }

  start();
  return {
    async call(name, message) {
      const whole = { ...message, call: name, parted };
      if (name === 'start') whole.wasm = await wasm;
      await ready; // wait for a restarted worker
      if (name === 'start' || name === 'files') remember(whole);
      return send(whole);
    },
    // Fetches the second part of the module before it is needed.
    fetchRest: () => (ways.rest?.length ? fetchPart('rest') : Promise.resolve()),
    // Asks the running call to end if the worker shares its memory. Returns false if only restart() can end the call. If the ended call is `endable`, it is
    // rejected (Ended). Any other call is sent again.
    cancel() {
      if (cancel) Atomics.store(cancel, 0, 1);
      return Boolean(cancel);
    },
    // Returns whether cancel() can end the running call.
    endsByFlag: () => Boolean(cancel),
    restart,
    end: () => worker.terminate(),
    set onprogress(listener) {
      onprogress = listener;
    },
  };
}
