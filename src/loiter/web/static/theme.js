// @ts-check
/** Light or dark: as the system says, until the switch says otherwise. */

const KEY = "loiter.theme";

/** @returns {string | null} */
function remembered() {
  // A browser may refuse to remember anything.
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/** @param {string} theme */
function remember(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Then the switch holds until the page is closed.
  }
}

/**
 * @param {HTMLButtonElement} button
 * @param {() => void} changed
 */
export function themes(button, changed) {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen = remembered();
  function apply() {
    const theme = chosen ?? (system.matches ? "dark" : "light");
    document.documentElement.dataset.theme = theme;
    button.setAttribute("aria-pressed", String(theme === "dark"));
    changed();
  }
  button.addEventListener("click", () => {
    chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    remember(chosen);
    apply();
  });
  system.addEventListener("change", apply);
  apply();
}
