// @ts-nocheck
/** The service worker of the site: it keeps the page, and answers from what it keeps. `make site` sets the version. */
const NAME = "loiter-VERSION";
const FILES = ["./", "map.html"];

addEventListener("install", (event) => {
  skipWaiting();
  event.waitUntil(caches.open(NAME).then((cache) => cache.addAll(FILES)));
});
addEventListener("activate", (event) =>
  event.waitUntil(
    caches
      .keys()
      .then((names) => Promise.all(names.filter((name) => name.startsWith("loiter-") && name !== NAME).map((name) => caches.delete(name)))),
  ),
);
addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || new URL(request.url).origin !== location.origin) return;
  const kept = caches.open(NAME).then((cache) => cache.match(request, { ignoreSearch: true }));
  event.respondWith(kept.then((response) => response ?? fetch(request)));
});
