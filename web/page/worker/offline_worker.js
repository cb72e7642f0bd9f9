// offline_worker.js: the service worker of the served page. The page starts it after the first picture (offline.js). It stores the page's files in a cache
// that is named by the hash of their contents. When a file changes, this script changes too. The new files replace the old files together, after all pages with
// the old files are closed. web/build.py lists the files with their hashes. Files in the browser's own cache are not downloaded again.
const CACHE = 'lambent-HASH';
const FILES = {};
// Files that are stored on first use. PLAIN and THREADS are alternatives: drawing with one thread or with several.
const LATER = [];
const PLAIN = [];
const THREADS = [];

// Takes a file from the browser's cache if possible. Otherwise takes it from the server. `known` is its name in FILES.
const answer = (request, known) => fetch(request, { cache: 'force-cache', integrity: FILES[known] }).catch(() => fetch(request, { cache: 'reload', integrity: FILES[known] }));

const nameOf = (address) => {
  const url = new URL(address), base = new URL('./', location);
  return url.origin === base.origin && url.pathname.startsWith(base.pathname) ? url.pathname.slice(base.pathname.length) || './' : null;
};

async function store(name) {
  const cache = await caches.open(CACHE), found = await answer(name, name);
  if (found.ok) await cache.put(name, found);
}

addEventListener('install', (event) => {
  const without = new Set([...LATER, ...(location.search === '?threads' ? PLAIN : THREADS)]);
  event.waitUntil(Object.keys(FILES).filter((name) => !without.has(name)).reduce((before, name) => before.then(() => store(name)), Promise.resolve()));
});

addEventListener('activate', (event) => {
  event.waitUntil(caches.keys().then((names) => Promise.all(names.filter((name) => name.startsWith('lambent-') && name !== CACHE).map((name) => caches.delete(name)))));
});

addEventListener('fetch', (event) => {
  const name = event.request.method === 'GET' ? nameOf(event.request.url) : null;
  if (name === null || !(name in FILES)) return;
  event.respondWith(caches.open(CACHE).then(async (cache) => {
    const kept = await cache.match(name);
    if (kept) return kept;
    const found = await fetch(event.request);
    if (found.ok) event.waitUntil(store(name).catch(() => {}));
    return found;
  }));
});
