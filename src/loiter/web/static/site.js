// @ts-check
/** The page as a site: the same page, which a service worker keeps for use without a network. */
import "./main.js";

if (location.protocol.startsWith("http")) navigator.serviceWorker?.register("worker.js");
