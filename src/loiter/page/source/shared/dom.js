// @ts-check
/** Helpers for the browser: elements, sizes, timers. */

const SVG = "http://www.w3.org/2000/svg";

/** @typedef {Record<string, string | number>} Attributes */

/**
 * A new SVG element.
 *
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} name
 * @param {Attributes} [attributes]
 * @param {(Element | string)[]} [children]
 * @returns {SVGElementTagNameMap[K]}
 */
export function svg(name, attributes = {}, children = []) {
  const element = document.createElementNS(SVG, name);
  setAttributes(element, attributes);
  element.append(...children);
  return element;
}

/**
 * A new HTML element.
 *
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} name
 * @param {Attributes} [attributes]
 * @param {(Element | string)[]} [children]
 * @returns {HTMLElementTagNameMap[K]}
 */
export function html(name, attributes = {}, children = []) {
  const element = document.createElement(name);
  setAttributes(element, attributes);
  element.append(...children);
  return element;
}

/** Set the attributes that differ: to set an equal one costs a browser a layout. @param {Element} element @param {Attributes} attributes */
export function setAttributes(element, attributes) {
  for (const name in attributes) {
    const value = String(attributes[name]);
    if (element.getAttribute(name) !== value) element.setAttribute(name, value);
  }
}

/**
 * An element to draw, as a description: to compare it with the last one is cheaper than to read the document.
 *
 * @typedef {{name: string, attributes: Attributes, children: (Part | string)[]}} Part
 *
 * @param {string} name
 * @param {Attributes} [attributes]
 * @param {(Part | string)[]} [children]
 * @returns {Part}
 */
export const part = (name, attributes = {}, children = []) => ({ name, attributes, children });

/** What `fill` has put into elements. @type {WeakMap<Element, (Part | string)[]>} */
const FILLED = new WeakMap();

/**
 * Give an element these children, and nothing else. What has not changed since the last time is left alone, so that the
 * browser neither lays it out nor paints it again, and it keeps its focus.
 *
 * @param {Element} parent
 * @param {(Part | string)[]} children
 */
export function fill(parent, children) {
  // What stands there at first is that of the page's file.
  if (!FILLED.has(parent)) parent.replaceChildren();
  const before = FILLED.get(parent) ?? [];
  FILLED.set(parent, children);
  let node = parent.firstChild;
  children.forEach((child, i) => {
    const old = /** @type {ChildNode} */ (node);
    node = node?.nextSibling ?? null;
    if (i < before.length) adapt(old, before[i], child);
    else parent.append(made(child, parent));
  });
  for (let i = children.length; i < before.length; i++) parent.lastChild?.remove();
}

/** @param {ChildNode} node @param {Part | string} before @param {Part | string} wanted */
function adapt(node, before, wanted) {
  if (typeof before === "string" && typeof wanted === "string") {
    if (before !== wanted) node.nodeValue = wanted;
  } else if (typeof before === "string" || typeof wanted === "string" || before.name !== wanted.name) {
    node.replaceWith(made(wanted, /** @type {Element} */ (node.parentNode)));
  } else {
    const element = /** @type {Element} */ (node);
    const [old, attributes] = [before.attributes, wanted.attributes];
    for (const name in old) if (!(name in attributes)) element.removeAttribute(name);
    for (const name in attributes)
      if (old[name] !== attributes[name]) element.setAttribute(name, String(attributes[name]));
    fill(element, wanted.children);
  }
}

/** @param {Part | string} wanted @param {Element} parent */
function made(wanted, parent) {
  if (typeof wanted === "string") return document.createTextNode(wanted);
  const element = document.createElementNS(parent.namespaceURI, wanted.name);
  setAttributes(element, wanted.attributes);
  fill(element, wanted.children);
  return element;
}

/**
 * SVG groups, one for each name, in drawing order.
 *
 * @template {string} K
 * @param {K[]} names
 * @returns {Record<K, SVGGElement>}
 */
export function svgLayers(...names) {
  const layers = names.map((name) => [name, svg("g", { class: `layer ${name}` })]);
  return /** @type {Record<K, SVGGElement>} */ (Object.fromEntries(layers));
}

/**
 * Set the size of a drawing, in pixels.
 *
 * @param {SVGSVGElement} drawing
 * @param {number} width
 * @param {number} height
 */
export function setSize(drawing, width, height) {
  setAttributes(drawing, { width, height, viewBox: `0 0 ${width} ${height}` });
}

/**
 * The element of the page with this id and class.
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
 * The `d` attribute of a polyline. Null starts a new piece. Hundredths of a pixel are finer than any screen.
 *
 * @param {([number, number] | null)[]} points
 */
export function polyline(points) {
  return points
    .map((point, i) => {
      const command = i > 0 && points[i - 1] ? "L" : "M";
      return point ? `${command}${point[0].toFixed(2)} ${point[1].toFixed(2)}` : "";
    })
    .join("");
}

/**
 * Tell which part of a group is under the pointer or has the focus: its index, or null.
 *
 * @param {Element} group
 * @param {string} selector  of the parts
 * @param {(index: number | null) => void} tell
 */
export function watchPointed(group, selector, tell) {
  // An SVG group that listens to the focus would be reached by Tab itself.
  const focus = !(group instanceof SVGElement);
  for (const event of ["pointerover", ...(focus ? ["focusin"] : [])])
    group.addEventListener(event, ({ target }) => {
      const part = /** @type {Element} */ (target).closest(selector);
      if (part) tell(Array.from(group.querySelectorAll(selector)).indexOf(part));
    });
  for (const event of ["pointerout", ...(focus ? ["focusout"] : [])]) group.addEventListener(event, () => tell(null));
}

/** Set a text, if it is another. @param {Element} element @param {string} text */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Show or hide an element. @param {Element} element @param {boolean} shown */
export function show(element, shown) {
  element.toggleAttribute("hidden", !shown);
  if (element instanceof SVGElement) setAttributes(element, { visibility: shown ? "visible" : "hidden" });
}

/**
 * Call a function with the size of a box in whole pixels: at once, and whenever the size changes.
 *
 * @param {HTMLElement} box
 * @param {(width: number, height: number) => void} resized
 */
export function observeSize(box, resized) {
  const measure = () => resized(Math.round(box.clientWidth), Math.round(box.clientHeight));
  new ResizeObserver(measure).observe(box);
  measure();
}

/** The box of an element on another, pixels from its upper left corner. @param {Element} element @param {Element} on */
export function boxWithin(element, on) {
  const { left, right, top, bottom } = element.getBoundingClientRect();
  const origin = on.getBoundingClientRect();
  return { left: left - origin.left, right: right - origin.left, top: top - origin.top, bottom: bottom - origin.top };
}

/** Whether keys are typed into a field. @param {EventTarget | null} target */
export const isTyping = (target) => target instanceof HTMLInputElement && target.type === "text";

/** Milliseconds without a change after which a drag counts as paused. */
export const PAUSE_MS = 140;

/**
 * A function that calls `act` once, when it has not been called for some time.
 *
 * @param {number} wait_ms
 * @param {() => void} act
 */
export function debounced(wait_ms, act) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = window.setTimeout(act, wait_ms);
  };
}
