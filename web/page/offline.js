// offline.js: the served page works without its server from the second visit on: a service worker (offline_worker.js) keeps its files. Not in the
// one-file page, which needs none.
if ('serviceWorker' in navigator && isSecureContext) navigator.serviceWorker.register(crossOriginIsolated ? 'offline_worker.js?threads' : 'offline_worker.js').catch(() => {});
