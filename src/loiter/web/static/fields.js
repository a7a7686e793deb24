// @ts-check
/**
 * Fields for numbers. What cannot be understood, or what the service refuses, is marked, with a sentence below the
 * field; the number that was there before stays in use until then.
 *
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./units.js").Quantity} Quantity
 *
 * @typedef {object} Source  the number that a field shows and sets
 * @property {() => Quantity} quantity
 * @property {() => Units} units
 * @property {() => number | undefined} get  in metres, metres per second or degrees; undefined where there is none
 * @property {(value: number | undefined, event: Event) => void} set
 * @property {boolean} [optional]  whether the field may be empty
 *
 * @typedef {object} Field
 * @property {() => void} draw  show the number as it is now
 * @property {(sentence: string | null) => void} refuse  mark the field with what is wrong with its number, or not any more
 * @property {() => string} typo  what is not understood of what is typed, or nothing
 */
import { entryOf } from "./entry.js";
import { html } from "./svg.js";
import { shortened, unit } from "./units.js";

const PAUSE_MS = 500; // a sentence about what is typed waits until the typing pauses: "12 k" may become "12 km"

/** @type {Record<string, number>} */
const ARROWS = { ArrowUp: 1, ArrowDown: -1 };

/**
 * What a field is called: "Radius of the circle".
 *
 * @param {HTMLElement} input
 */
export function nameOf(input) {
  const label = input.closest("label")?.querySelector("span")?.textContent;
  return input.getAttribute("aria-label") ?? label ?? "The field";
}

/**
 * @param {HTMLInputElement} input
 * @param {Source} source
 * @returns {Field}
 */
export function numberField(input, source) {
  const fault = faultBelow(input);
  let waiting = 0;
  let typo = ""; // what is wrong with the text
  let refused = ""; // what is wrong with the number
  /** @type {number | undefined} */
  let known; // the number that the text stands for, or that stays in use while the text is wrong

  function mark() {
    input.setAttribute("aria-invalid", String(typo !== "" || refused !== ""));
    clearTimeout(waiting);
    const say = () => (fault.textContent = typo || refused);
    if (typo !== "" && document.activeElement === input && fault.textContent === "")
      waiting = window.setTimeout(say, PAUSE_MS);
    else say();
  }

  /** @param {Event} event */
  function type(event) {
    const empty = source.optional && input.value.trim() === "";
    const entry = empty ? { value: undefined } : entryOf(input.value, source.quantity(), source.units());
    typo = "problem" in entry ? `${nameOf(input)} ${entry.problem}` : "";
    refused = "";
    known = "value" in entry ? entry.value : source.get();
    mark();
    if ("value" in entry) source.set(entry.value, event);
  }

  function draw() {
    const { name, size } = unit(source.quantity(), source.units());
    const suffix = input.nextElementSibling;
    if (suffix) suffix.textContent = name;
    const value = source.get();
    // What is being typed, or is wrong, stays as it is typed, unless something else changes the number.
    if (value === known && (typo !== "" || document.activeElement === input)) return mark();
    [typo, known] = ["", value];
    mark();
    input.value = value === undefined ? "" : String(shortened(value / size));
  }

  input.addEventListener("input", type);
  input.addEventListener("blur", draw);
  input.addEventListener("keydown", (event) => {
    const value = source.get();
    const step = ARROWS[event.key];
    if (!step || value === undefined || typo !== "") return;
    const { size } = unit(source.quantity(), source.units());
    input.value = String(shortened(value / size + step));
    type(event);
    event.preventDefault();
  });
  return {
    draw,
    typo: () => typo,
    refuse(sentence) {
      refused = sentence ?? "";
      mark();
    },
  };
}

/**
 * A choice of which one has to be made.
 *
 * @param {HTMLSelectElement} select
 * @param {() => string} get
 * @param {(value: string) => void} set
 * @returns {Field}
 */
export function choiceField(select, get, set) {
  const fault = faultBelow(select);
  /** @param {string | null} sentence */
  function refuse(sentence) {
    fault.textContent = sentence ?? "";
    select.setAttribute("aria-invalid", String(sentence !== null));
  }
  select.addEventListener("change", () => {
    refuse(null);
    set(select.value);
  });
  return { draw: () => (select.value = get()), refuse, typo: () => "" };
}

/**
 * The line below a field that says what is wrong with it.
 *
 * @param {HTMLElement} input
 */
function faultBelow(input) {
  const fault = html("p", { id: `${input.id}-fault`, class: "fault", role: "alert" });
  (input.closest("label, .pair") ?? input).after(fault);
  input.setAttribute("aria-describedby", fault.id);
  return fault;
}
