// @ts-check
/**
 * The light or dark theme: that of the system, until the user switches.
 *
 * @import {Store} from "../state/store.js"
 * @import {Theme} from "../state/page_state.js"
 */
import { byId } from "./dom.js";
import { recall, remember } from "./storage.js";

/** @param {Store} store */
export function themeSwitch(store) {
  const button = byId("theme", HTMLButtonElement);
  const system = matchMedia("(prefers-color-scheme: dark)");
  const useStored = () => store.update({ theme: asTheme(recall("theme")) ?? (system.matches ? "dark" : "light") });
  button.addEventListener("click", () => {
    const theme = store.get().theme === "dark" ? "light" : "dark";
    remember("theme", theme);
    store.update({ theme });
  });
  system.addEventListener("change", useStored);
  useStored();
  store.watch(
    ({ theme }) => [theme],
    ({ theme }) => {
      document.documentElement.dataset.theme = theme;
      button.setAttribute("aria-pressed", String(theme === "dark"));
    },
  );
}

/** @param {string | null} text @returns {Theme | null} */
const asTheme = (text) => (text === "dark" || text === "light" ? text : null);
