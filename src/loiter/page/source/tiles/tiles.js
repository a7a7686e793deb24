// @ts-check
/**
 * Draws map tiles in a document of its own, behind the plan view. Its security policy allows pictures from other
 * machines, and is narrowed here to one tile server; that of the page allows none. The page sends what to show.
 *
 * @import {View} from "../shared/geometry.js"
 * @import {Origin} from "../shared/types.js"
 * @typedef {{view: View, origin: Origin, theme: string}} Shown
 */
import { html } from "../shared/dom.js";
import { addressOf, matrixOf, tilesFor } from "./grid.js";

const template = new URLSearchParams(location.search).get("tiles") ?? "";

// Of several policies all hold.
const policy = { "http-equiv": "Content-Security-Policy", content: `img-src ${new URL(template).origin}` };
document.head.append(html("meta", policy));

/** @type {Map<string, {picture: HTMLImageElement, tile: import("./grid.js").Tile}>} */
const drawn = new Map();

addEventListener("message", ({ source, origin, data }) => {
  if (source === parent && origin === location.origin) show(data);
});
parent.postMessage({ isReady: true }, location.origin);

/** @param {Shown} shown */
function show({ view, origin, theme }) {
  document.documentElement.dataset.theme = theme;
  const wanted = tilesFor(view, origin).map((tile) => ({ tile, address: addressOf(template, tile) }));
  for (const { tile, address } of wanted) if (!drawn.has(address)) drawn.set(address, { picture: load(address), tile });
  const kept = new Set(wanted.map(({ address }) => address));
  const isComplete = wanted.every(({ address }) => drawn.get(address)?.picture.complete);
  for (const [address, { picture, tile }] of drawn) {
    // Tiles of the scale before stay until the new ones are there.
    if (!kept.has(address) && (isComplete || !picture.complete || drawn.size > 300)) remove(address);
    else picture.style.transform = `matrix(${matrixOf(tile, view, origin).map((part) => part.toFixed(6))})`;
    picture.style.zIndex = kept.has(address) ? "1" : "0";
  }
}

/** @param {string} address */
function load(address) {
  const picture = html("img", { alt: "", draggable: "false", src: address });
  picture.addEventListener("load", () => {
    picture.classList.add("loaded");
    parent.postMessage({ isLoaded: true }, location.origin);
  });
  picture.addEventListener("error", () => parent.postMessage({ isLoaded: false }, location.origin));
  document.body.append(picture);
  return picture;
}

/** @param {string} address */
function remove(address) {
  drawn.get(address)?.picture.remove();
  drawn.delete(address);
}
