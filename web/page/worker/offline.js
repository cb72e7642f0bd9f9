// offline.js: makes the served page work offline from the second visit on. A service worker (offline_worker.js) stores the page's files. It is started when the
// first picture is shown and the later files have been fetched, so that it does not delay them.
export function keepOffline() {
  if (ONE_FILE || !('serviceWorker' in navigator) || !isSecureContext || document.getElementById('served')) return;
  navigator.serviceWorker.register(crossOriginIsolated ? 'offline_worker.js?threads' : 'offline_worker.js').catch(() => {});
}
