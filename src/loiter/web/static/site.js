// @ts-check
/** The page as a site: the same page, which a service worker keeps for use without a network. Its one script is also that of the worker that searches for clear entries. */
if (typeof document === "undefined") import("./requests/clear_worker.js");
else {
  import("./main.js");
  if (location.protocol.startsWith("http")) navigator.serviceWorker?.register("worker.js");
}
