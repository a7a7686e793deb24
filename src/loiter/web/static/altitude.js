// @ts-check
/**
 * How high a mission is flown: the altitude, what it is measured from, and home's own altitude. Nothing of it is assumed.
 *
 * @typedef {import("./types.js").Altitude} Altitude
 * @typedef {import("./types.js").Reference} Reference
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./plan.js").Shown} Shown
 */
import { choiceField, numberField } from "./fields.js";
import { REFERENCES } from "./scene.js";
import { byId, show } from "./svg.js";
import { fixed, unit } from "./units.js";

/** @type {Record<Reference, string>} */
const ABOVE = { msl: "above mean sea level", home: "above home", ground: "above the ground" };

/**
 * @param {() => Shown} shown
 * @param {(altitude: Altitude) => void} change
 */
export function altitudeFields(shown, change) {
  const home = byId("home", HTMLElement);
  /** @param {"altitude_m" | "home_altitude_m"} name @returns {import("./fields.js").Source} */
  const sourceOf = (name) => ({
    quantity: () => "length",
    units: () => shown().units,
    get: () => shown().altitude[name],
    set: (value) => change({ ...shown().altitude, [name]: value }),
    optional: true,
  });
  const fields = {
    altitude: numberField(byId("altitude", HTMLInputElement), sourceOf("altitude_m")),
    "altitude-reference": choiceField(
      byId("altitude-reference", HTMLSelectElement),
      () => shown().altitude.altitude_reference ?? "",
      (value) => {
        change({ ...shown().altitude, altitude_reference: REFERENCES.find((reference) => reference === value) });
        draw();
      },
    ),
    "home-altitude": numberField(byId("home-altitude", HTMLInputElement), sourceOf("home_altitude_m")),
  };

  function draw() {
    show(home, needsHome(shown().altitude));
    for (const field of Object.values(fields)) field.draw();
  }
  return { draw, fields };
}

/** Whether home's own altitude has to be given. @param {Altitude} altitude */
const needsHome = ({ altitude_reference }) => altitude_reference === "home" || altitude_reference === "ground";

/**
 * What a mission still lacks: a sentence for each field that has to be filled in.
 *
 * @param {Altitude} altitude
 * @returns {Record<string, string>}
 */
export function lacking(altitude) {
  const { altitude_m, altitude_reference, home_altitude_m } = altitude;
  /** @type {Record<string, string>} */
  const sentences = {};
  if (altitude_m === undefined) sentences.altitude = "A mission needs an altitude.";
  if (!altitude_reference) sentences["altitude-reference"] = "Choose what the altitude is measured from.";
  if (needsHome(altitude) && home_altitude_m === undefined)
    sentences["home-altitude"] = "A mission needs home's own altitude too.";
  return sentences;
}

/**
 * The altitude as the service takes it for a mission, without what is not shown.
 *
 * @param {Altitude} altitude
 * @returns {Altitude}
 */
export function ofMission({ home_altitude_m, ...flown }) {
  return needsHome(flown) ? { ...flown, home_altitude_m } : flown;
}

/**
 * The altitude as maps and tables hold it, who measure it from mean sea level; nothing where that is not known.
 *
 * @param {Altitude} altitude
 * @returns {Altitude}
 */
export function ofMap(altitude) {
  const { altitude_m, altitude_reference, home_altitude_m } = altitude;
  const known = altitude_reference === "msl" || (altitude_reference === "home" && home_altitude_m !== undefined);
  return known && altitude_m !== undefined ? ofMission(altitude) : {};
}

/**
 * The altitude of a mission in words: "120 m above home, which is at 450 m".
 *
 * @param {Altitude} altitude
 * @param {Units} units
 */
export function inWords(altitude, units) {
  const { altitude_m = 0, altitude_reference = "msl", home_altitude_m = 0 } = altitude;
  const { name, size } = unit("length", units);
  const told = (/** @type {number} */ metres) => `${fixed(metres / size, 1).replace(".0", "")} ${name}`;
  const home = needsHome(altitude) ? `, home at ${told(home_altitude_m)}` : "";
  return `${told(altitude_m)} ${ABOVE[altitude_reference]}${home}`;
}
