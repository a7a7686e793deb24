// @ts-check
/** What the browser remembers of the user's choices. It may forbid that; then they are lost when the page is closed. */

/** @param {"theme" | "tiles" | "units"} key @returns {string | null} */
export function recall(key) {
  try {
    return localStorage.getItem(`loiter.${key}`);
  } catch {
    return null;
  }
}

/** @param {"theme" | "tiles" | "units"} key @param {string} value */
export function remember(key, value) {
  try {
    localStorage.setItem(`loiter.${key}`, value);
  } catch {
    // Nothing else depends on it.
  }
}
