// @ts-nocheck
// Arrays of NumPy, of up to three axes, as far as the code translated from Python uses them: elements of double
// precision, broadcasting, indices, reductions. Arrays of bool are masks.

/** An array: its elements one after the other; `shape` has the lengths of its axes. */
export class Vector extends Float64Array {
  get shape() {
    return this.axes ?? [this.length];
  }
  get size() {
    return this.length;
  }
  /** The elements, or the rows along the first axis. */
  [Symbol.iterator]() {
    return this.axes ? rowsOf(this)[Symbol.iterator]() : this.values();
  }
  /** The transpose of two axes. */
  get T() {
    const [n, m] = this.shape;
    return filled([m, n], (k) => this[(k % n) * m + Math.floor(k / n)]);
  }
  ravel() {
    return new Vector(this);
  }
  reshape(...shape) {
    const known = shape.reduce((product, one) => (one < 0 ? product : product * one), 1);
    return shaped(new Vector(this), shape.map((one) => (one < 0 ? this.length / known : one)));
  }
  nonzero() {
    const found = [];
    for (let i = 0; i < this.length; i++) if (this[i] !== 0) found.push(i);
    return [Vector.from(found)];
  }
  astype() {
    return this;
  }
  min({ axis } = {}) {
    return reduced(this, axis, (best, one) => (one < best ? one : best), Infinity);
  }
  max({ axis } = {}) {
    return reduced(this, axis, (best, one) => (one > best ? one : best), -Infinity);
  }
  sum({ axis } = {}) {
    return reduced(this, axis, (total, one) => total + one, 0);
  }
  all({ axis } = {}) {
    return reduced(this, axis, (is, one) => Number(is !== 0 && one !== 0), 1);
  }
  /** The index of the least element, or of the least along the first axis. */
  argmin({ axis } = {}) {
    if (axis === undefined) return this.reduce((best, one, i) => (one < this[best] ? i : best), 0);
    const width = this.length / this.shape[0];
    return filled(this.shape.slice(1), (k) => {
      let best = k;
      for (let i = k; i < this.length; i += width) if (this[i] < this[best]) best = i;
      return (best - k) / width;
    });
  }
}

/** An array of truth values, 0 or 1. */
export class Mask extends Vector {}

/** A slice of indices. */
export class Slice {
  constructor(start, end) {
    [this.start, this.end] = [start, end];
  }
}

/** Give an array its axes. */
function shaped(array, shape) {
  if (shape.length !== 1) array.axes = shape;
  return array;
}
const sizeOf = (shape) => shape.reduce((product, one) => product * one, 1);
const shapeOf = (a) => (a instanceof Vector ? a.shape : []);

/** An array of the values of a function of the indices. */
export function filled(shape, value, kind = Vector) {
  const found = new kind(sizeOf(shape));
  for (let i = 0; i < found.length; i++) found[i] = value(i);
  return shaped(found, shape);
}

/** Numbers, or sequences of them, as an array. */
export function array(all) {
  if (all instanceof Vector) return all.axes ? shaped(all.slice(), all.axes) : all.slice();
  if (typeof all === "number" || typeof all === "boolean") return Number(all);
  const list = Array.from(all);
  if (list.length === 0 || typeof list[0] !== "object") return Vector.from(list, Number);
  return stack(list.map((one) => array(one)));
}

/** The rows of an array along its first axis, in the same memory. */
export function rowsOf(all) {
  const { shape } = all;
  if (shape.length === 1) return all;
  const width = sizeOf(shape.slice(1));
  return Array.from({ length: shape[0] }, (_, i) => shaped(all.subarray(i * width, (i + 1) * width), shape.slice(1)));
}

// Elements

/** The shape of several arrays that broadcast. */
function common(shapes) {
  const rank = Math.max(...shapes.map((shape) => shape.length));
  return Array.from({ length: rank }, (_, i) => {
    const lengths = shapes.map((shape) => shape[shape.length - rank + i] ?? 1);
    return lengths.find((one) => one !== 1) ?? 1;
  });
}

const AXES = 3;

/** The steps in memory for each of three axes of a shape; 0 where an array is repeated. */
function strides(a, shape) {
  const own = shapeOf(a);
  const found = [0, 0, 0];
  let step = 1;
  for (let i = 1; i <= own.length; i++) {
    if (own[own.length - i] !== 1) found[AXES - i] = step;
    step *= own[own.length - i];
  }
  return found;
}

/** A function of each element of up to three arrays or numbers, as an array of their common shape. */
function spread(change, kind, operands) {
  const shape = common(operands.map(shapeOf));
  const found = shaped(new kind(sizeOf(shape)), shape);
  const n2 = shape[shape.length - 1] ?? 1;
  const n1 = shape[shape.length - 2] ?? 1;
  const [a, b = [0], c = [0]] = operands.map((one) => (one instanceof Vector ? one : [Number(one)]));
  const steps = [0, 1, 2].map((i) => strides(operands[i] ?? 0, shape));
  const [[, , a2], [, , b2], [, , c2]] = steps;
  for (let row = 0, k = 0; k < found.length; row++) {
    const [i, j] = [Math.floor(row / n1), row % n1];
    let ka = i * steps[0][0] + j * steps[0][1];
    let kb = i * steps[1][0] + j * steps[1][1];
    let kc = i * steps[2][0] + j * steps[2][1];
    for (const end = k + n2; k < end; k++) {
      found[k] = change(a[ka], b[kb], c[kc]);
      ka += a2;
      kb += b2;
      kc += c2;
    }
  }
  return found;
}

/** The sequences among operands as arrays. */
const operand = (a) => (Array.isArray(a) ? array(a) : a);

/** A function of one number for arrays too. */
export const unary =
  (change, kind = Vector) =>
  (a) => {
    if (!(a instanceof Vector)) return Array.isArray(a) ? unary(change, kind)(array(a)) : change(Number(a));
    const found = new kind(a.length);
    for (let i = 0; i < a.length; i++) found[i] = change(a[i]);
    return a.axes ? shaped(found, a.axes) : found;
  };

/** A function of two numbers for arrays too, of which at least one is an array. */
export function binary(change, a, b, kind = Vector) {
  [a, b] = [operand(a), operand(b)];
  if (a instanceof Vector && b instanceof Vector) {
    if (a.length !== b.length || ((a.axes || b.axes) && String(a.axes) !== String(b.axes))) return spread(change, kind, [a, b]);
    const found = new kind(a.length);
    for (let i = 0; i < a.length; i++) found[i] = change(a[i], b[i]);
    return a.axes ? shaped(found, a.axes) : found;
  }
  const like = a instanceof Vector ? a : b;
  const found = new kind(like.length);
  if (a === like) for (let i = 0, one = Number(b); i < found.length; i++) found[i] = change(a[i], one);
  else for (let i = 0, one = Number(a); i < found.length; i++) found[i] = change(one, b[i]);
  return like.axes ? shaped(found, like.axes) : found;
}

const ofTwo = (change, kind) => (a, b) => {
  const isArray = [a, b].some((one) => one instanceof Vector || Array.isArray(one));
  return isArray ? binary(change, a, b, kind) : change(Number(a), Number(b));
};

function where(condition, a, b) {
  const all = [condition, a, b];
  if (!all.some((one) => one instanceof Vector)) return condition ? a : b;
  return spread((is, one, other) => (is ? one : other), Vector, all);
}

/** The distance from the origin; `Math.hypot` is slow, and needed only where squares leave the range of numbers. */
function hypot(x, y) {
  const square = x * x + y * y;
  return square > 1e-290 && square < 1e290 ? Math.sqrt(square) : Math.hypot(x, y);
}

// Reductions

function reduced(all, axis, change, first) {
  if (axis === undefined || all.shape.length === 1) {
    let found = first;
    for (let i = 0; i < all.length; i++) found = change(found, all[i]);
    return found;
  }
  const { shape } = all;
  const k = axis < 0 ? shape.length + axis : axis;
  const [inner, n] = [sizeOf(shape.slice(k + 1)), shape[k]];
  return filled([...shape.slice(0, k), ...shape.slice(k + 1)], (i) => {
    const start = Math.floor(i / inner) * n * inner + (i % inner);
    let found = first;
    for (let j = 0; j < n; j++) found = change(found, all[start + j * inner]);
    return found;
  });
}

// Indices

/** The indices that a key takes of an axis of some length. */
function taken(key, length) {
  if (key instanceof Slice) {
    const from = (one, otherwise) => Math.min(length, one == null ? otherwise : one < 0 ? Math.max(0, length + one) : one);
    const [start, end] = [from(key.start, 0), from(key.end, length)];
    return filled([Math.max(0, end - start)], (i) => start + i);
  }
  if (key instanceof Mask) return key.nonzero()[0];
  return typeof key === "number" ? [key < 0 ? length + key : key] : key;
}

/** The elements of an array at keys: numbers, slices, masks and arrays of indices; null is a new axis. */
export function at(all, keys) {
  if (keys.length === 1 && !all.axes) {
    const found = taken(keys[0], all.length);
    if (typeof keys[0] === "number") return all[found[0]];
    const [source, part] = [all, new all.constructor(found.length)];
    for (let i = 0; i < found.length; i++) part[i] = source[found[i] < 0 ? all.length + found[i] : found[i]];
    return found.axes ? shaped(part, found.axes) : part;
  }
  const { shape } = all;
  // A column.
  if (keys.length === 2 && keys[1] === null && !all.axes) {
    const column = keys[0] instanceof Slice && keys[0].start == null && keys[0].end == null ? all.slice() : at(all, [keys[0]]);
    return shaped(column, [column.length, 1]);
  }
  if (keys.length === 1 && typeof keys[0] !== "number" && keys[0] !== null) return rowsAt(all, taken(keys[0], shape[0]));
  const wanted = [...keys, ...Array(Math.max(0, shape.length - keys.filter((one) => one !== null).length)).fill(new Slice())];
  const found = []; // the lengths of the result
  let offsets = [0];
  let axis = 0;
  for (const key of wanted) {
    if (key === null) {
      found.push(1);
      continue;
    }
    const step = sizeOf(shape.slice(axis + 1));
    const indices = taken(key, shape[axis++]);
    const next = new Array(offsets.length * indices.length);
    for (let i = 0, k = 0; i < offsets.length; i++) for (let j = 0; j < indices.length; j++) next[k++] = offsets[i] + step * indices[j];
    offsets = next;
    if (typeof key !== "number") found.push(indices.length);
  }
  if (found.length === 0) return all[offsets[0]];
  return filled(found, (i) => all[offsets[i]], all.constructor);
}

/** The rows of an array at indices. */
function rowsAt(all, indices) {
  const { shape } = all;
  const width = sizeOf(shape.slice(1));
  const found = new all.constructor(indices.length * width);
  for (let i = 0; i < indices.length; i++) for (let j = 0; j < width; j++) found[i * width + j] = all[indices[i] * width + j];
  return shaped(found, [indices.length, ...shape.slice(1)]);
}

/** Set elements of an array, or rows along its first axis. */
export function put(all, key, value) {
  const width = sizeOf(all.shape.slice(1));
  const indices = taken(key, all.shape[0]);
  for (let i = 0; i < indices.length; i++)
    for (let j = 0; j < width; j++)
      all[indices[i] * width + j] = value instanceof Vector ? value[value.length === width ? j : i * width + j] : Number(value);
}

/** An array with other elements before those at indices. */
function insert(all, indices, values) {
  const found = new Vector(all.length + indices.length);
  for (let i = 0, k = 0; i <= all.length; i++) {
    if (k < indices.length && indices[k] === i) found[i + k] = values[k++];
    if (i < all.length) found[i + k] = all[i];
  }
  return found;
}

// Complex numbers, whose parts may be arrays

export class Complex {
  constructor(real, imag) {
    this.real = real;
    this.imag = imag;
  }
}
const times = ofTwo((a, b) => a * b);
const exp = unary(Math.exp);
/** Real functions, and what they are of complex numbers. */
const ofComplex = (ofReal, ofBoth) => (z) => (z instanceof Complex ? ofBoth(z) : ofReal(z));

// The module

function stack(all, { axis = 0 } = {}) {
  const parts = Array.from(all);
  const whole = new Vector(parts.length * (parts[0].length ?? 1));
  parts.forEach((part, i) => (parts[0] instanceof Vector ? whole.set(part, i * part.length) : (whole[i] = part)));
  const shape = [parts.length, ...shapeOf(parts[0])];
  if (axis === 0) return shaped(whole, shape);
  // The last axis.
  const n = parts.length;
  return filled([...shape.slice(1), n], (i) => parts[i % n][Math.floor(i / n)]);
}

function concatenate(all) {
  const parts = Array.from(all, (one) => (one instanceof Vector ? one : Vector.from(one)));
  const found = new Vector(parts.reduce((length, one) => length + one.length, 0));
  let end = 0;
  for (const one of parts) {
    found.set(one, end);
    end += one.length;
  }
  const { shape } = parts[0];
  return shaped(found, [parts.reduce((length, one) => length + one.shape[0], 0), ...shape.slice(1)]);
}

/** Each element so many times. */
function repeat(all, counts) {
  const found = [];
  const times = (i) => (typeof counts === "number" ? counts : counts[i]);
  for (let i = 0; i < all.length; i++) for (let k = 0; k < times(i); k++) found.push(all[i]);
  return Vector.from(found);
}

/** An array repeated so many times, as rows where two numbers are given. */
function tile(all, times) {
  const [n, isRows] = Array.isArray(times) ? [times[0], true] : [times, false];
  return filled(isRows ? [n, all.length] : [n * all.length], (i) => all[i % all.length]);
}

/** An array with the elements of another one, repeated. */
function broadcast_to(all, shape) {
  if (String(all.shape) === String(shape)) return all;
  const length = sizeOf(shape);
  const n = shape[shape.length - 1];
  if (!all.axes && all.length === n) return filled(shape, (i) => all[i % n], all.constructor);
  return length === 0 ? constant(0)(shape) : spread((one) => one, all.constructor, [all, constant(0)(shape)]);
}

/** A quotient where a mask is set, otherwise the element of `out`. */
const divide = (a, b, { out, where: is }) => where(is, binary((x, y) => x / y, a, b), out);

const dimensions = (shape) => (typeof shape === "number" ? [shape] : shape);
const constant = (value) => (shape, kind) => filled(dimensions(shape), () => value, kind === Boolean ? Mask : Vector);

const minimum = Object.assign(ofTwo(Math.min), {
  at(all, indices, values) {
    for (let i = 0; i < indices.length; i++) if (values[i] < all[indices[i]]) all[indices[i]] = values[i];
  },
  reduceat: (all, starts) =>
    filled([starts.length], (i) => all.subarray(starts[i], starts[i + 1] ?? all.length).reduce((least, one) => Math.min(least, one))),
});
const logical_and = {
  at(all, indices, values) {
    for (let i = 0; i < indices.length; i++) if (values[i] === 0) all[indices[i]] = 0;
  },
};

const DEGREE = Math.PI / 180;
export const np = {
  abs: ofComplex(unary(Math.abs), ({ real, imag }) => np.hypot(real, imag)),
  angle: ({ real, imag }) => np.arctan2(imag, real),
  exp: ofComplex(exp, ({ real, imag }) => new Complex(times(exp(real), np.cos(imag)), times(exp(real), np.sin(imag)))),
  fmin: ofTwo((a, b) => (b < a || Number.isNaN(a) ? b : a)),
  insert,
  sin: unary(Math.sin),
  cos: unary(Math.cos),
  sqrt: unary(Math.sqrt),
  ceil: unary(Math.ceil),
  floor: unary(Math.floor),
  arccos: unary(Math.acos),
  arcsin: unary(Math.asin),
  radians: unary((a) => a * DEGREE),
  degrees: unary((a) => a * (180 / Math.PI)),
  isnan: unary((a) => Number(Number.isNaN(a)), Mask),
  flatnonzero: (all) => all.nonzero()[0],
  isfinite: unary((a) => Number(Number.isFinite(a)), Mask),
  hypot: ofTwo(hypot),
  arctan2: ofTwo(Math.atan2),
  maximum: ofTwo(Math.max),
  mod: ofTwo((a, b) => a - Math.floor(a / b) * b),
  minimum,
  logical_and,
  clip: (a, least, most) => unary((one) => Math.min(Math.max(one, least), most))(a),
  divide,
  where,
  inf: Infinity,
  pi: Math.PI,
  finfo: () => ({ tiny: 2 ** -1022 }),
  array,
  asarray: array,
  arange: (start, end, step) =>
    end === undefined ? filled([start], (i) => i) : filled([Math.max(0, Math.ceil((end - start) / step))], (i) => start + i * step),
  full: (shape, value) => constant(Number(value))(shape),
  zeros: constant(0),
  ones: constant(1),
  empty: constant(0),
  full_like: (all, value) => constant(value)(all.shape),
  ones_like: (all) => constant(1)(all.shape),
  zeros_like: (all) => (all instanceof Vector ? constant(0)(all.shape) : 0),
  linspace: (start, end, count) => filled([count], (i) => (i === count - 1 ? end : start + (i * (end - start)) / (count - 1))),
  searchsorted: (all, found) => found.map((one) => all.findLastIndex((other) => other < one) + 1),
  broadcast: (...all) => ({ shape: common(all.map(shapeOf)) }),
  broadcast_shapes: (...shapes) => common(shapes),
  broadcast_to,
  broadcast_arrays(...all) {
    const shape = common(all.map(shapeOf));
    return shape.length === 0 ? all : all.map((one) => np.broadcast_to(one, shape));
  },
  stack,
  concatenate,
  append: (all, more) => concatenate([all, typeof more === "number" ? [more] : more]),
  split(all, count) {
    const n = all.length / count;
    return Array.from({ length: count }, (_, i) => all.slice(i * n, (i + 1) * n));
  },
  repeat,
  tile,
  cumsum(all) {
    let total = 0;
    return Vector.from(all, (one) => (total += one));
  },
  argsort: (all) => Vector.from(Array.from(all.keys()).sort((i, j) => all[i] - all[j])),
  choose(indices, choices) {
    const options = choices instanceof Vector ? rowsOf(choices) : Array.from(choices);
    const whole = options.map((one) => np.broadcast_to(one, indices.shape));
    return filled(indices.shape, (i) => whole[indices[i]][i]);
  },
};
