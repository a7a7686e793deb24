// @ts-check
/** The one script of the page: on the page itself, and in the worker that searches for clear entries. */
if (typeof document === "undefined") import("./requests/clear_worker.js");
else {
  import("./main.js");
  // A site has a service worker, which keeps it for use without a network.
  const worker = document.querySelector('meta[name="worker"]')?.getAttribute("content");
  if (worker && location.protocol.startsWith("http")) navigator.serviceWorker?.register(worker);
}
