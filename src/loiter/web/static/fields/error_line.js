// @ts-check
/** Errors below fields. */
import { html } from "../shared/dom.js";

/**
 * A new line below a field for the sentence that says what is wrong with it.
 *
 * @param {HTMLElement} field
 */
export function errorLine(field) {
  const line = html("p", { id: `${field.id}-fault`, class: "fault", role: "alert" });
  (field.closest("label, .pair") ?? field).after(line);
  field.setAttribute("aria-describedby", line.id);
  return line;
}

/**
 * @param {HTMLElement} field
 * @param {boolean} invalid
 */
export const markInvalid = (field, invalid) => field.setAttribute("aria-invalid", String(invalid));
