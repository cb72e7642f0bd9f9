// offline.js: the served page works without its server from the second visit on: a service worker (offline_worker.js) keeps its files. It starts when the
// first picture is there and the files that follow it are loaded, so that it takes no part of the line from them.
export function keepOffline() {
  if (ONE_FILE || !('serviceWorker' in navigator) || !isSecureContext || document.getElementById('served')) return;
  navigator.serviceWorker.register(crossOriginIsolated ? 'offline_worker.js?threads' : 'offline_worker.js').catch(() => {});
}
