// @ts-check
/**
 * The reduced plane: which word wins where, the curves between, and the state on it (the paper's Fig. 4, live).
 *
 * @typedef {import("./types.js").Synthesis} Synthesis
 * @typedef {import("./types.js").Maneuver} Maneuver
 * @typedef {import("./types.js").Turn} Turn
 * @typedef {import("./plan.js").Shown} Shown
 * @typedef {import("./view.js").View} View
 * @typedef {import("./view.js").Point} Point
 */
import { makeHandle, place } from "./draggable.js";
import { byId, polyline, set, show, svg } from "./svg.js";
import { pieces, sorted } from "./track.js";
import { fixed, nice, tidy } from "./units.js";
import { toScreen, toWorld } from "./view.js";

/** How strongly a word shades its region: the hue is that of its first control. */
const STRENGTH = /** @type {Record<string, number>} */ ({
  RSR: 0.18,
  RSL: 0.3,
  RL: 0.52,
  RLR: 0.72,
  R: 0.72,
  LSR: 0.18,
  LSL: 0.3,
  LR: 0.52,
  LRL: 0.72,
  L: 0.72,
  SR: 0.6,
  SL: 0.6,
});

/**
 * How far the map reaches, turn radii: enough for the circle, doubled until the state is on it.
 *
 * @param {number} radius
 * @param {{x: number, y: number}} state
 */
export function reachFor(radius, { x, y }) {
  const least = Math.ceil(2 * (radius + 3)) / 2;
  const far = Math.max(Math.abs(x), Math.abs(y)) * 1.04;
  return least * 2 ** Math.max(0, Math.min(12, Math.ceil(Math.log2(far / least))));
}

/**
 * @param {() => Shown} shown
 * @param {(x: number, y: number, event: Event) => void} move  the state is dragged here
 */
export function reducedView(shown, move) {
  const canvas = byId("regions", HTMLCanvasElement);
  const root = byId("reduced", SVGSVGElement);
  const [axes, curves, words, path, targets] = ["axes", "curves", "words", "way", "targets"].map((name) =>
    svg("g", { class: `layer ${name}` }),
  );
  const ghost = svg("circle", { r: 5, class: "ghostdot" });
  const state = svg("g", { id: "state", "data-needs-plan": "" }, [
    svg("circle", { r: 18, class: "touch" }),
    svg("circle", { r: 12, class: "focus" }),
    svg("circle", { r: 7, class: "statedot" }),
  ]);
  root.append(axes, curves, path, words, targets, ghost, state);
  /** @type {View} */
  let view = { scale: 40, east: 0, north: 0, width: 380, height: 380 };
  /** @type {Synthesis | null} */
  let synthesis = null;

  const here = () => shown().answer?.reduced ?? { x: 0, y: 0, radius: 1 };
  /** @returns {Point} */
  const dot = () => pinned(toScreen(view, here().x, here().y), view);
  makeHandle(state, root, "State in the reduced plane", {
    where: dot,
    to: (point, event) => {
      const [x, y] = toWorld(view, point);
      move(tidy(x, 0.05 / view.scale), tidy(y, 0.05 / view.scale), event);
    },
    by: (right, up, event) => {
      const step = nice(60 / view.scale) / 20;
      move(here().x + right * step, here().y + up * step, event);
    },
  });

  show(state, false); // until there is one

  /** @param {Synthesis} next */
  function map(next) {
    synthesis = next;
    drawMap();
  }

  function drawMap() {
    if (!synthesis) return;
    const { x } = synthesis;
    // The grid's points are middles of cells; the map reaches half a cell further.
    const reach = (x[x.length - 1] * x.length) / (x.length - 1);
    view = { ...view, scale: view.width / (2 * reach) };
    paint(canvas, synthesis);
    drawAxes(axes, view);
    curves.replaceChildren(...synthesis.curves.map((curve) => drawCurve(view, curve)));
    words.replaceChildren(...labels(view, synthesis));
    targets.replaceChildren(...goals(view, synthesis));
    draw();
  }

  function draw() {
    const { answer } = shown();
    if (!answer) return;
    const { x, y } = answer.reduced;
    show(state, true);
    place(state, dot(), tidy(x, 1e-6), `x ${fixed(x, 2)}, y ${fixed(y, 2)} turn radii`);
    path.replaceChildren(...sorted(answer).best.flatMap((maneuver) => drawWay(view, maneuver)));
  }

  /** @param {{x: number, y: number} | null} instant */
  function fly(instant) {
    show(ghost, instant !== null);
    if (!instant) return;
    const [cx, cy] = toScreen(view, instant.x, instant.y);
    set(ghost, { cx: cx.toFixed(2), cy: cy.toFixed(2) });
  }

  /** @param {number} side pixels */
  function resize(side) {
    view = { ...view, width: side, height: side };
    set(root, { width: side, height: side, viewBox: `0 0 ${side} ${side}` });
    drawMap();
  }
  return { map, draw, drawMap, fly, resize };
}

/**
 * A point kept on the map.
 *
 * @param {Point} point
 * @param {View} view
 * @returns {Point}
 */
function pinned([x, y], { width, height }) {
  return [Math.min(width - 4, Math.max(4, x)), Math.min(height - 4, Math.max(4, y))];
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {Synthesis} synthesis
 */
function paint(canvas, { region, words, x, y }) {
  canvas.width = x.length;
  canvas.height = y.length;
  const context = canvas.getContext("2d");
  if (!context) return;
  const image = context.createImageData(x.length, y.length);
  const colours = words.map(shade);
  region.forEach((row, j) => {
    // The first row is the lowest y, the last of the image.
    let k = 4 * (y.length - 1 - j) * x.length;
    for (const index of row) {
      image.data.set(index < 0 ? [0, 0, 0, 0] : colours[index], k);
      k += 4;
    }
  });
  context.putImageData(image, 0, 0);
}

/**
 * A word's colour, as the theme has it.
 *
 * @param {string} word
 * @returns {[number, number, number, number]}
 */
function shade(word) {
  const hue = getComputedStyle(document.documentElement)
    .getPropertyValue(`--${word[0] || "S"}`)
    .trim();
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(hue.slice(i, i + 2), 16));
  return [r, g, b, Math.round(255 * (STRENGTH[word] ?? 0.4))];
}

/**
 * @param {SVGGElement} layer
 * @param {View} view
 */
function drawAxes(layer, view) {
  const step = nice(60 / view.scale);
  const decimals = Math.max(0, -Math.floor(Math.log10(step)));
  const count = Math.floor(view.width / 2 / view.scale / step);
  const [cx, cy] = toScreen(view, 0, 0);
  /** @type {SVGElement[]} */
  const parts = [svg("path", { d: `M${cx} 0V${view.height}M0 ${cy}H${view.width}` })];
  for (let k = -count; k <= count; k++) {
    const [x, y] = toScreen(view, k * step, k * step);
    if (k === 0 || x < 18 || x > view.width - 18) continue;
    parts.push(svg("text", { x, y: view.height - 6, "text-anchor": "middle" }, [fixed(k * step, decimals)]));
    parts.push(svg("text", { x: 5, y: y + 4 }, [fixed(k * step, decimals)]));
  }
  parts.push(svg("text", { x: view.width - 6, y: cy - 6, "text-anchor": "end", class: "axisname" }, ["x"]));
  parts.push(svg("text", { x: cx + 7, y: 13, class: "axisname" }, ["y"]));
  layer.replaceChildren(...parts);
}

/**
 * @param {View} view
 * @param {import("./types.js").Curve} curve
 */
function drawCurve(view, { kind, x, y }) {
  const points = x.map((value, i) => {
    const other = y[i];
    return value === null || other === null ? null : toScreen(view, value, other);
  });
  return svg("path", { d: polyline(points), class: `curve ${kind}` });
}

/**
 * The word of each region, where it is farthest from its border, in each half of the plane.
 *
 * @param {View} view
 * @param {Synthesis} synthesis
 */
function labels(view, { region, words, x, y }) {
  const half = y.length >> 1;
  return words.flatMap((word, index) =>
    [region.slice(0, half), region.slice(half)].flatMap((rows, upper) => {
      const { depth, row, column } = deepest(rows, index);
      // Narrower than its label a region is told by its colour alone.
      const pixels = depth * (x[1] - x[0]) * view.scale;
      if (pixels < 12) return [];
      const [left, top] = toScreen(view, x[column], y[row + (upper ? half : 0)]);
      return [svg("text", { x: left, y: top + 4, "text-anchor": "middle" }, [word])];
    }),
  );
}

/**
 * The cell of a region that is farthest from any cell outside it, in steps along rows and columns (two sweeps).
 *
 * @param {number[][]} rows
 * @param {number} index
 */
function deepest(rows, index) {
  const width = rows[0].length;
  const steps = rows.map((row) => row.map((value) => (value === index ? Infinity : 0)));
  const reach = (/** @type {number} */ j, /** @type {number} */ i) =>
    j < 0 || i < 0 || j >= rows.length || i >= width ? 0 : steps[j][i];
  let found = { depth: 0, row: 0, column: 0 };
  for (let j = 0; j < rows.length; j++)
    for (let i = 0; i < width; i++) steps[j][i] = Math.min(steps[j][i], reach(j - 1, i) + 1, reach(j, i - 1) + 1);
  for (let j = rows.length - 1; j >= 0; j--)
    for (let i = width - 1; i >= 0; i--) {
      const depth = Math.min(steps[j][i], reach(j + 1, i) + 1, reach(j, i + 1) + 1);
      steps[j][i] = depth;
      if (depth > found.depth) found = { depth, row: j, column: i };
    }
  return found;
}

/**
 * Where the circle is: the points (0, R), clockwise, and (0, -R), counter-clockwise, as far as the turn allows them.
 *
 * @param {View} view
 * @param {Synthesis} synthesis
 */
function goals(view, { radius, turn }) {
  const ends = [
    { turn: "cw", y: radius },
    { turn: "ccw", y: -radius },
  ].filter((end) => turn === "either" || turn === end.turn);
  return ends.map((end) => {
    const [cx, cy] = toScreen(view, 0, end.y);
    return svg("circle", { cx, cy, r: 4.5 });
  });
}

/**
 * @param {View} view
 * @param {Maneuver} maneuver
 */
function drawWay(view, maneuver) {
  const { x, y } = maneuver.track;
  const lines = pieces(maneuver).map(({ letter, indices }) => ({
    letter,
    d: polyline(indices.map((i) => toScreen(view, x[i], y[i]))),
  }));
  return [
    ...lines.map(({ d }) => svg("path", { d, class: "casing" })),
    ...lines.map(({ d, letter }) => svg("path", { d, class: `piece ${letter}` })),
  ];
}
