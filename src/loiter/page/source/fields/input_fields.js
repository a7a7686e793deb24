// @ts-check
/**
 * Fields for numbers and choices. If a text is not a number, or the library refuses the number, the field is marked,
 * with a sentence below it. Until the text is corrected, the previous number stays in use.
 *
 * @import {Store} from "../state/store.js"
 * @import {Quantity} from "../shared/units.js"
 *
 * @typedef {object} Source  the number that a field shows and sets
 * @property {() => Quantity} quantity
 * @property {() => number | undefined} get  in metres, metres per second or degrees; undefined if there is none
 * @property {(value: number | undefined, event: Event) => void} set
 * @property {boolean} [optional]  whether the field may be empty
 * @property {(text: string) => import("./number_text.js").Entry} [parse]  reads a text that is no plain number
 * @property {(value: number) => number} [shown]  the number as it is shown; six digits by default
 * @property {(text: string, event: Event) => boolean} [takeAll]  takes a text that sets several fields, or returns false
 *
 * @typedef {object} Field
 * @property {() => void} draw  show the present number; fields of numbers do so whenever it changes
 * @property {(sentence: string | null) => void} refuse  mark the number as wrong, or remove the mark
 * @property {() => string} typo  the error in the text, or nothing
 * @property {() => void} [redraw]  show the present number in place of the text
 */
import { byId, html, setAttributes, setText } from "../shared/dom.js";
import { sixDigits, unitOf } from "../shared/units.js";
import { nameOf } from "./field_names.js";
import { parseNumber } from "./number_text.js";

/** A new line below a field for the sentence that says what is wrong with it. @param {HTMLElement} field */
export function errorLine(field) {
  const line = html("p", { id: `${field.id}-fault`, class: "fault", role: "alert" });
  (field.closest("label, .pair") ?? field).after(line);
  field.setAttribute("aria-describedby", `${field.getAttribute("aria-describedby") ?? ""} ${line.id}`.trim());
  return line;
}

/** @param {HTMLElement} field @param {boolean} invalid */
export const markInvalid = (field, invalid) => setAttributes(field, { "aria-invalid": String(invalid) });

const TYPING_PAUSE_MS = 500; // an error is shown when the typing pauses: "12 k" may become "12 km"

/** @type {Record<string, number>} */
const ARROWS = { ArrowUp: 1, ArrowDown: -1 };

/** @implements {Field} */
class NumberField {
  /** @param {HTMLInputElement} input @param {Source} source @param {Store} store */
  constructor(input, source, store) {
    this.input = input;
    this.source = source;
    this.units = () => store.get().units;
    this.line = errorLine(input);
    this.timer = 0;
    this.textError = "";
    this.numberError = "";
    /** @type {number | undefined} */
    this.known = undefined; // the number of the text, or the one that stays in use while the text is wrong
    input.addEventListener("input", (event) => this.read(event));
    input.addEventListener("blur", () => this.draw());
    input.addEventListener("keydown", (event) => this.step(event));
    store.watch(
      ({ units }) => [source.get(), source.quantity(), units],
      () => this.draw(),
    );
  }

  draw() {
    const { input, source } = this;
    const { name, size } = unitOf(source.quantity(), this.units());
    const suffix = input.nextElementSibling;
    if (suffix) setText(suffix, name);
    const value = source.get();
    // While a text is being typed, or is wrong, it stays until something else changes the number.
    if (value === this.known && (this.textError !== "" || this.hasFocus())) return this.mark();
    [this.textError, this.known] = ["", value];
    this.mark();
    input.value = value === undefined ? "" : String((source.shown ?? sixDigits)(value / size));
  }

  /** @param {string | null} sentence */
  refuse(sentence) {
    this.numberError = sentence ?? "";
    this.mark();
  }

  typo() {
    return this.textError;
  }

  hasFocus() {
    return document.activeElement === this.input;
  }

  /** Use the number that is typed. @param {Event} event */
  read(event) {
    const { input, source } = this;
    if (source.takeAll?.(input.value, event)) {
      // The text stays while it is typed: "47.1, 8" may become "47.1, 8.2".
      [this.textError, this.numberError, this.known] = ["", "", source.get()];
      return this.mark();
    }
    const isEmpty = source.optional && input.value.trim() === "";
    const entry = isEmpty ? { value: undefined } : this.parse(input.value);
    this.textError = "problem" in entry ? `${nameOf(input)} ${entry.problem}` : "";
    this.numberError = "";
    this.known = "value" in entry ? entry.value : source.get();
    this.mark();
    if ("value" in entry) source.set(entry.value, event);
  }

  /** @param {string} text @returns {import("./number_text.js").Entry} */
  parse(text) {
    const { source } = this;
    return source.parse ? source.parse(text) : parseNumber(text, source.quantity(), this.units());
  }

  /** Show the present number in place of the text. */
  redraw() {
    [this.textError, this.numberError, this.known] = ["", "", NaN];
    this.draw();
  }

  /** Change the number with the arrow keys. @param {KeyboardEvent} event */
  step(event) {
    const { input, source } = this;
    const value = source.get();
    const step = ARROWS[event.key];
    if (!step || value === undefined || this.textError !== "") return;
    const { size } = unitOf(source.quantity(), this.units());
    input.value = String(sixDigits(value / size + step));
    this.read(event);
    event.preventDefault();
  }

  mark() {
    const sentence = this.textError || this.numberError;
    markInvalid(this.input, sentence !== "");
    if (this.timer) clearTimeout(this.timer);
    this.timer = 0;
    const write = () => setText(this.line, sentence);
    const isNew = this.textError !== "" && this.hasFocus() && this.line.textContent === "";
    if (isNew) this.timer = window.setTimeout(write, TYPING_PAUSE_MS);
    else write();
  }
}

/** @param {string} id @param {Source} source @param {Store} store @returns {Field} */
export const numberField = (id, source, store) => new NumberField(byId(id, HTMLInputElement), source, store);

/** Fields by their ids. @param {Record<string, Source>} sources @param {Store} store @returns {Record<string, Field>} */
export const numberFields = (sources, store) =>
  Object.fromEntries(Object.entries(sources).map(([id, source]) => [id, numberField(id, source, store)]));

/**
 * A choice among radio buttons.
 *
 * @param {HTMLElement} group
 * @param {() => string} get
 * @param {(value: any, event: Event) => void} set
 * @returns {Field}
 */
export function choiceField(group, get, set) {
  const line = errorLine(group);
  const inputs = group.querySelectorAll("input");
  /** @param {string | null} sentence */
  function refuse(sentence) {
    setText(line, sentence ?? "");
    markInvalid(group, sentence !== null);
  }
  group.addEventListener("change", (event) => {
    refuse(null);
    set(/** @type {HTMLInputElement} */ (event.target).value, event);
  });
  return { draw: () => inputs.forEach((input) => (input.checked = input.value === get())), refuse, typo: () => "" };
}
