// @ts-check
/**
 * Taking the plan away: files, Python, a command line, a link.
 *
 * @typedef {import("./plan.js").Shown} Shown
 */
import { post } from "./api.js";
import { byId, html } from "./svg.js";
import { shortened, unit } from "./units.js";

/** The formats of the service, with what they are for. */
const FORMATS = /** @type {[string, string, string][]} */ ([
  ["geojson", "GeoJSON", "for maps"],
  ["kml", "KML", "for Google Earth"],
  ["gpx", "GPX", "for receivers"],
  ["csv", "CSV", "samples along the track"],
  ["plan", "Plan", "mission for QGroundControl"],
  ["waypoints", "WPL", "waypoints for Mission Planner"],
  ["png", "PNG", "picture"],
  ["svg", "SVG", "picture"],
]);

/**
 * @param {() => Shown} shown
 * @param {() => string} link
 * @param {(sentence: string, bad?: boolean) => void} say
 */
export function takeAway(shown, link, say) {
  const list = byId("formats", HTMLElement);
  const altitude = byId("altitude", HTMLInputElement);
  let altitude_m = 100;
  altitude.addEventListener(
    "input",
    () => (altitude_m = altitude.valueAsNumber * unit("length", shown().units).size),
  );
  for (const [format, name, use] of FORMATS) {
    const button = html(
      "button",
      { type: "button", title: use, "aria-label": `Save ${name}, ${use}`, "data-format": format },
      [name],
    );
    button.addEventListener("click", () => fetchFile(format).catch((error) => say(error.message, true)));
    list.append(button);
  }

  /** @param {string} format */
  async function fetchFile(format) {
    const body = { ...shown().scene, ...(Number.isFinite(altitude_m) ? { altitude_m } : {}) };
    const response = await post(`/api/export/${format}`, body);
    const name =
      /filename="?([^";]+)"?/.exec(response.headers.get("Content-Disposition") ?? "")?.[1] ?? `entry.${format}`;
    save(await response.blob(), name);
    say(`${name} saved.`);
  }

  /**
   * @param {string} id
   * @param {() => string} text
   * @param {string} what
   */
  function copies(id, text, what) {
    byId(id, HTMLButtonElement).addEventListener("click", () =>
      navigator.clipboard.writeText(text()).then(
        () => say(`${what} copied.`),
        () => say("The browser does not let this page copy; select the text instead.", true),
      ),
    );
  }
  copies("copy-python", () => shown().answer?.python ?? "", "Python");
  copies("copy-command", () => shown().answer?.command ?? "", "Command");
  copies("copy-link", link, "Link");
  const code = { python: byId("python", HTMLElement), command: byId("command", HTMLElement) };
  return {
    draw() {
      const { answer, units } = shown();
      const { name, size } = unit("length", units);
      byId("altitude-unit", HTMLElement).textContent = name;
      if (document.activeElement !== altitude)
        altitude.value = Number.isFinite(altitude_m) ? String(shortened(altitude_m / size)) : "";
      code.python.textContent = answer?.python ?? "";
      code.command.textContent = answer?.command ?? "";
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
