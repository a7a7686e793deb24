// @ts-check
/** Elements, made in one line. */

const SVG = "http://www.w3.org/2000/svg";

/**
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} name
 * @param {Record<string, string | number>} [attributes]
 * @param {(Element | string)[]} [children]
 * @returns {SVGElementTagNameMap[K]}
 */
export function svg(name, attributes = {}, children = []) {
  const element = document.createElementNS(SVG, name);
  set(element, attributes);
  element.append(...children);
  return element;
}

/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} name
 * @param {Record<string, string | number>} [attributes]
 * @param {(Element | string)[]} [children]
 * @returns {HTMLElementTagNameMap[K]}
 */
export function html(name, attributes = {}, children = []) {
  const element = document.createElement(name);
  set(element, attributes);
  element.append(...children);
  return element;
}

/**
 * @param {Element} element
 * @param {Record<string, string | number>} attributes
 */
export function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}

/**
 * The element of the page with an id, of the class given.
 *
 * @template {Element} T
 * @param {string} id
 * @param {new () => T} kind
 * @returns {T}
 */
export function byId(id, kind) {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`the page has no ${kind.name} #${id}`);
  return element;
}

/**
 * The `d` of a polyline; null breaks it. Hundredths of a pixel are below what a screen shows.
 *
 * @param {([number, number] | null)[]} points
 */
export function polyline(points) {
  let begun = false;
  return points
    .map((point) => {
      const command = begun ? "L" : "M";
      begun = point !== null;
      return point ? `${command}${point[0].toFixed(2)} ${point[1].toFixed(2)}` : "";
    })
    .join("");
}

/**
 * Whether an element is drawn.
 *
 * @param {Element} element
 * @param {boolean} shown
 */
export function show(element, shown) {
  element.toggleAttribute("hidden", !shown);
  if (element instanceof SVGElement) element.setAttribute("visibility", shown ? "visible" : "hidden");
}

/**
 * A word with each letter in the colour of its control.
 *
 * @param {string} word
 */
export function wordOf(word) {
  if (!word) return html("span", { class: "word" }, ["hold"]);
  return html(
    "span",
    { class: "word" },
    Array.from(word, (letter) => html("span", { class: letter }, [letter])),
  );
}
