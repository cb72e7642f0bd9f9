// offline.js: makes the served page work offline from the second visit on, by a service worker (offline_worker.js) that stores its files. The service worker
// starts after the first picture and the files that follow it, so that it does not delay them.
export function keepOffline() {
  if (ONE_FILE || !('serviceWorker' in navigator) || !isSecureContext || document.getElementById('served')) return;
  navigator.serviceWorker.register(crossOriginIsolated ? 'offline_worker.js?threads' : 'offline_worker.js').catch(() => {});
}
