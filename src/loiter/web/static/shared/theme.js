// @ts-check
/**
 * The light or dark theme: that of the system, until the user switches.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").Theme} Theme
 */
import { byId } from "./dom.js";

const KEY = "loiter.theme";

/** @returns {string | null} */
function readTheme() {
  // A browser may forbid storage.
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/** @param {Theme} theme */
function storeTheme(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Then the choice is lost when the page is closed.
  }
}

/** @param {Store} store */
export function themeSwitch(store) {
  const button = byId("theme", HTMLButtonElement);
  const system = matchMedia("(prefers-color-scheme: dark)");
  const useStored = () => store.update({ theme: asTheme(readTheme()) ?? (system.matches ? "dark" : "light") });
  button.addEventListener("click", () => {
    const theme = store.get().theme === "dark" ? "light" : "dark";
    storeTheme(theme);
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
