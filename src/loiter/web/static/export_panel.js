// @ts-check
/**
 * Taking the plan away: files, Python, a command line, a link.
 *
 * @typedef {import("./plan.js").Shown} Shown
 */
import { inWords, lacking, ofMap, ofMission } from "./altitude.js";
import { file } from "./api.js";
import { byId, html } from "./svg.js";

/**
 * The formats of the service, with what they are for.
 *
 * @typedef {"map" | "table" | "mission" | "picture"} Kind
 * @type {{format: string, name: string, use: string, kind: Kind}[]}
 */
const FORMATS = [
  { format: "geojson", name: "GeoJSON", use: "for maps", kind: "map" },
  { format: "kml", name: "KML", use: "for Google Earth", kind: "map" },
  { format: "gpx", name: "GPX", use: "for receivers", kind: "map" },
  { format: "csv", name: "CSV", use: "samples along the track", kind: "table" },
  { format: "plan", name: "Plan", use: "mission for QGroundControl", kind: "mission" },
  { format: "waypoints", name: "WPL", use: "waypoints for Mission Planner", kind: "mission" },
  { format: "png", name: "PNG", use: "picture", kind: "picture" },
  { format: "svg", name: "SVG", use: "picture", kind: "picture" },
];

/**
 * @typedef {object} Telling  how the page tells what became of a file
 * @property {(sentence: string, bad?: boolean) => void} say
 * @property {(error: Error) => void} refuse
 * @property {(sentences: Record<string, string>) => void} ask  mark fields that have to be filled in, by their ids
 * @property {(id: string) => string} typo  what is not understood of what is typed in a field, or nothing
 *
 * @param {() => Shown} shown
 * @param {() => string} link
 * @param {Telling} telling
 */
export function exportPanel(shown, link, { say, refuse, ask, typo }) {
  const list = byId("formats", HTMLElement);
  for (const { format, name, use, kind } of FORMATS) {
    const button = html(
      "button",
      { type: "button", title: use, "aria-label": `Save ${name}, ${use}`, "data-format": format, "data-needs-plan": "" },
      [name],
    );
    button.addEventListener("click", () => {
      const sentences = needed(kind);
      if (Object.keys(sentences).length > 0) ask(sentences);
      else fetchFile(format, kind).catch(refuse);
    });
    list.append(button);
  }

  /**
   * What a file still needs: a sentence for each field.
   *
   * @param {Kind} kind
   * @returns {Record<string, string>}
   */
  function needed(kind) {
    const { scene, altitude } = shown();
    return {
      ...(scene.origin || !["map", "mission"].includes(kind) ? {} : placeless()),
      ...(kind === "mission" ? lacking(altitude) : {}),
      ...(kind === "picture" ? {} : misread()),
    };
  }

  /** The empty fields of the place. */
  const placeless = () =>
    Object.fromEntries(
      ["latitude", "longitude"]
        .filter((id) => byId(id, HTMLInputElement).value.trim() === "")
        .map((id) => [id, "Where does (0, 0) lie on Earth? The file needs it."]),
    );

  /** The fields of place and altitude that are not understood. */
  const misread = () =>
    Object.fromEntries(
      ["latitude", "longitude", "altitude", "home-altitude"]
        .map((id) => [id, typo(id)])
        .filter(([, sentence]) => sentence !== ""),
    );

  /**
   * @param {string} format
   * @param {Kind} kind
   */
  async function fetchFile(format, kind) {
    const { scene, altitude, units } = shown();
    const flown = kind === "mission" ? ofMission(altitude) : kind === "picture" ? {} : ofMap(altitude);
    const { content, name = `entry.${format}` } = await file(`/api/export/${format}`, { ...scene, ...flown });
    save(content, name);
    if (kind === "mission") say(`${name} saved: ${inWords(flown, units)}.`);
    else if (kind !== "picture" && altitude.altitude_m !== undefined && flown.altitude_m === undefined)
      say(`${name} saved, without the altitude: how high that is above mean sea level is not known.`);
    else say(`${name} saved.`);
  }

  /**
   * @param {string} id
   * @param {() => string | undefined} text  undefined while the plan is not there yet
   * @param {string} what
   */
  function copies(id, text, what) {
    byId(id, HTMLButtonElement).addEventListener("click", () => {
      const copied = text();
      if (copied === undefined) return say("The plan of this scene is still on its way.", true);
      navigator.clipboard.writeText(copied).then(
        () => say(`${what} copied.`),
        () => say("The browser does not let this page copy; select the text instead.", true),
      );
    });
  }
  const present = () => (shown().current ? shown().answer : null);
  copies("copy-python", () => present()?.python, "Python");
  copies("copy-command", () => present()?.command, "Command");
  copies("copy-link", link, "Link");
  const code = { python: byId("python", HTMLElement), command: byId("command", HTMLElement) };
  return {
    draw() {
      code.python.textContent = present()?.python ?? "";
      code.command.textContent = present()?.command ?? "";
    },
  };
}

/**
 * @param {Blob} blob
 * @param {string} name
 */
function save(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = html("a", { href: address, download: name });
  link.click();
  // Long after the browser has begun to read it.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
