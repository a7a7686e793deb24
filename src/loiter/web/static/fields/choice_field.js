// @ts-check
/**
 * A list from which the user must choose.
 *
 * @typedef {import("./number_field.js").Field} Field
 */
import { errorLine, markInvalid } from "./error_line.js";

/**
 * @param {HTMLSelectElement} select
 * @param {() => string} get
 * @param {(value: string) => void} set
 * @returns {Field}
 */
export function choiceField(select, get, set) {
  const line = errorLine(select);
  /** @param {string | null} sentence */
  function refuse(sentence) {
    line.textContent = sentence ?? "";
    markInvalid(select, sentence !== null);
  }
  select.addEventListener("change", () => {
    refuse(null);
    set(select.value);
  });
  return { draw: () => (select.value = get()), refuse, typo: () => "" };
}
