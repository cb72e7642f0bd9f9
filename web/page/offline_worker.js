// offline_worker.js: the service worker of the served page. It keeps the page's own files, FILES of web/build.py, in a cache named by the hash of
// their contents: when one of them changes, this script does too, and the new files replace the old ones together, once no page uses those.
const CACHE = 'lambent-HASH';
const FILES = [], THREADS = []; // THREADS: of a page that draws with several threads

addEventListener('install', (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll([...FILES, ...(location.search === '?threads' ? THREADS : [])].map((name) => new Request(name, { cache: 'no-cache' })))));
});

addEventListener('activate', (event) => {
  event.waitUntil(caches.keys().then((names) => Promise.all(names.filter((name) => name.startsWith('lambent-') && name !== CACHE).map((name) => caches.delete(name)))));
});

addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || new URL(event.request.url).origin !== location.origin) return;
  event.respondWith(caches.open(CACHE).then(async (cache) => (await cache.match(event.request, { ignoreSearch: true })) ?? fetch(event.request)));
});
