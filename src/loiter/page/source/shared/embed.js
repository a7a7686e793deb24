// @ts-check
/**
 * The page inside another one, `?embed`: the plan alone, with a link that opens the whole page.
 *
 * @import {Store} from "../state/store.js"
 */
import { linkOf } from "../scene/address.js";
import { byId } from "./dom.js";

/** Whether the page is embedded. */
export const isEmbedded = new URLSearchParams(location.search).has("embed");

/** @param {Store} store */
export function embedView(store) {
  if (!isEmbedded) return;
  document.documentElement.classList.add("embed");
  const link = byId("open-page", HTMLAnchorElement);
  link.hidden = false;
  store.watch(
    ({ scene, units, camera }) => [scene, units, camera],
    (state) => (link.href = linkOf(state)),
  );
}
