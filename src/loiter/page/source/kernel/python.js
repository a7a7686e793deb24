// @ts-nocheck
// What Python's values do, for code that is translated from it without types (`codegen/library.py`): numbers, complex
// numbers, arrays and text under its operators and formats, and what that code calls of its library.

import { Word } from "./kernel.js";
import { Complex, Mask, Slice, Vector, array, at, binary, filled, np, put, rowsOf, unary } from "./numpy.js";

// Values

const isList = (a) => Array.isArray(a) || a instanceof Vector;

/** A frozen dataclass. */
export class Values {
  __post_init__() {}
}

/** A named tuple: its elements are its fields. */
export class Tuple {
  __post_init__() {}
  [Symbol.iterator]() {
    return Object.values(this)[Symbol.iterator]();
  }
  _asdict() {
    return asdict(this);
  }
}

/** A function that makes values of a class, as Python's classes do; it has the names of their fields. The name of the
 * class is given: the page is built with shorter ones. */
export function struct(kind, fields, title) {
  kind.fields = fields;
  kind.title = title;
  const make = (...given) => new kind(...given);
  const methods = Object.getOwnPropertyNames(kind).filter((name) => typeof kind[name] === "function");
  for (const name of methods) make[name] = (...given) => kind[name](make, ...given);
  return Object.assign(make, { _fields: fields, kind });
}

/** Whether a value is of one of some classes. */
export const isinstance = (value, ...makers) => makers.some(({ kind }) => value instanceof kind);

/** The members of an enumeration; their values stand for them. */
export const enumeration = (members) => ({
  ...members,
  [Symbol.iterator]: () => Object.values(members)[Symbol.iterator](),
});

/** A value with other fields. */
export function replace(value, changes) {
  const fields = { ...value, ...changes };
  const { constructor } = value;
  return constructor.fields ? new constructor(...constructor.fields.map((name) => fields[name])) : fields;
}

const CACHE = new WeakMap();

/** A property that is computed once. */
export function cached(owner, name, compute) {
  if (!CACHE.has(owner)) CACHE.set(owner, {});
  return (CACHE.get(owner)[name] ??= compute());
}

export const asdict = (value) => new Map(Object.entries(value));

/** Python's values as plain ones of JavaScript. */
export function plain(value) {
  if (value instanceof Map) return Object.fromEntries([...value].map(([key, one]) => [key, plain(one)]));
  if (value instanceof Tuple) return Array.from(value, plain);
  if (!isList(value)) return value;
  if (typeof value[0] !== "number") return Array.from(value, plain);
  return value instanceof Vector ? Array.from(value) : value;
}

// Operators

const number = (a) => (typeof a === "boolean" ? Number(a) : a);
const complex = (a) => (a instanceof Complex ? a : new Complex(number(a), 0));

/** An operator of numbers that takes arrays and complex numbers too. */
function operator(ofNumbers, ofComplex) {
  return function apply(a, b) {
    if (typeof a === "number" && typeof b === "number") return ofNumbers(a, b);
    if (a instanceof Complex || b instanceof Complex) return ofComplex(complex(a), complex(b));
    if (a instanceof Vector || b instanceof Vector) return binary(ofNumbers, a, b);
    return ofNumbers(number(a), number(b));
  };
}

const addNumbers = operator(
  (a, b) => a + b,
  (a, b) => new Complex(add(a.real, b.real), add(a.imag, b.imag)),
);
export function add(a, b) {
  if (typeof a === "string") return a + b;
  return Array.isArray(a) ? [...a, ...iter(b)] : addNumbers(a, b);
}
export const sub = operator(
  (a, b) => a - b,
  (a, b) => new Complex(sub(a.real, b.real), sub(a.imag, b.imag)),
);
const mulNumbers = operator(
  (a, b) => a * b,
  (a, b) => new Complex(sub(mul(a.real, b.real), mul(a.imag, b.imag)), add(mul(a.real, b.imag), mul(a.imag, b.real))),
);
export function mul(a, b) {
  return Array.isArray(a) ? Array(Math.max(0, number(b))).fill(a).flat() : mulNumbers(a, b);
}
export const div = operator(
  (a, b) => a / b,
  (a, b) => {
    const size = add(mul(b.real, b.real), mul(b.imag, b.imag));
    const { real, imag } = mul(a, conjugate_(b));
    return new Complex(div(real, size), div(imag, size));
  },
);
/** The remainder, with the sign of the divisor. */
export const mod = operator((a, b) => {
  const rest = a % b;
  if (rest === 0) return b < 0 ? -0 : 0;
  return rest < 0 !== b < 0 ? rest + b : rest;
});
export const pow = operator((a, b) => a ** b);
export const floordiv = operator((a, b) => Math.floor(a / b));
export const bit_and = (a, b) => (isArray(a, b) ? binary((one, other) => one & other, a, b, Mask) : a & b);
export function bit_or(a, b) {
  if (a instanceof Map) return new Map([...a, ...b]);
  return isArray(a, b) ? binary((one, other) => one | other, a, b, Mask) : a | b;
}
export const neg = (a) => (a instanceof Complex ? mul(a, -1) : typeof a === "number" ? -a : mul(a, -1));
/** Not, of truth values. */
export const invert = unary((a) => Number(a === 0), Mask);

const isArray = (a, b) => a instanceof Vector || b instanceof Vector;
const order = (compare) => (a, b) => (isArray(a, b) ? binary(compare, a, b, Mask) : compare(a, b));
export const lt = order((a, b) => a < b);
export const le = order((a, b) => a <= b);
export const gt = order((a, b) => a > b);
export const ge = order((a, b) => a >= b);

/** Whether two values are equal: of arrays, which elements are. */
export const eq = (a, b) => (isArray(a, b) ? binary((one, other) => one === other, a, b, Mask) : same(a, b));
function same(a, b) {
  if (a === b || (a == null && b == null)) return true;
  if (a instanceof Complex || b instanceof Complex) return complex(a).real === complex(b).real && complex(a).imag === complex(b).imag;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return false;
  const [ones, others] = [Object.values(a), Object.values(b)];
  return ones.length === others.length && ones.every((one, i) => same(one, others[i]));
}
export const ne = (a, b) => (isArray(a, b) ? binary((one, other) => one !== other, a, b, Mask) : !same(a, b));
export const has = (a, all) => (all instanceof Map ? all.has(a) : typeof all === "string" ? all.includes(a) : iter(all).some((one) => eq(a, one)));

export function truth(a) {
  if (a instanceof Map) return a.size > 0;
  return isList(a) ? a.length > 0 : Boolean(a);
}
export const and = (a, b) => (truth(a) ? b() : a);
export const or = (a, b) => (truth(a) ? a : b());

// Sequences

/** The elements of anything that Python iterates over, as an array. */
export function iter(all) {
  if (Array.isArray(all)) return all;
  if (all instanceof Vector) return all.axes ? rowsOf(all) : all;
  if (all instanceof Map) return [...all.keys()];
  return all[Symbol.iterator] ? [...all] : Object.values(all);
}
export const list = (all = []) => Array.from(iter(all));
export const tuple = list;
/** The elements, each of which is a sequence, as arrays. */
export const rows = (all) => iter(all).map((one) => iter(one));
export const dict = { fromkeys: (all) => new Map(iter(all).map((key) => [key, null])) };
export const iter_items = (map) => [...map];
/** The elements of a sequence, those of its middle as one array. */
export function with_middle(all, before, after) {
  const found = iter(all);
  const end = found.length - after;
  return [...found.slice(0, before), found.slice(before, end), ...found.slice(end)];
}
export function item(all, key) {
  if (all instanceof Map) return all.get(key);
  if (all instanceof Vector && !(typeof key === "number" && !all.axes)) return at(all, keysOf(key));
  const found = typeof all === "string" ? all : iter(all);
  return found[key < 0 ? found.length + key : key];
}
/** The indices of an array: a tuple has one for each axis, a list has several of the first axis. */
function keysOf(key) {
  if (!Array.isArray(key)) return [key];
  return key.some((one) => one === null || one instanceof Slice) ? key : [array(key)];
}
export function set_item(all, key, value) {
  if (all instanceof Map) all.set(key, value);
  else if (all instanceof Vector) put(all, key, value);
  else all[key] = value;
}
export const slice = (...ends) => (ends.length === 1 ? new Slice(null, ends[0]) : new Slice(...ends));
export function sliced(all, start, end, step) {
  if (all instanceof Vector && step === null) return at(all, [new Slice(start, end)]);
  const found = typeof all === "string" ? all : iter(all);
  const part = found.slice(start ?? 0, end ?? undefined);
  return step === -1 ? [...part].reverse() : part;
}
export const set_of = (all) => [...new Set(iter(all))];
export const set = set_of;
export const len = (all) => (all instanceof Map ? all.size : typeof all === "string" ? all.length : iter(all).length);
export const range = (first, end) =>
  Array.from({ length: Math.max(0, end === undefined ? first : end - first) }, (_, i) => (end === undefined ? i : first + i));
export const zip = (...all) => {
  const columns = all.map(iter);
  return Array.from({ length: Math.min(...columns.map((one) => one.length)) }, (_, i) => columns.map((one) => one[i]));
};
export const enumerate = (all, { start = 0 } = {}) => iter(all).map((one, i) => [start + i, one]);
export const map = (change, ...all) => zip(...all).map((each) => change(...each));
export const reversed = (all) => list(all).reverse();
export const pairwise = (all) => iter(all).slice(1).map((one, i) => [iter(all)[i], one]);
export function accumulate(all, change) {
  const found = [];
  for (const one of iter(all)) found.push(found.length ? change(found[found.length - 1], one) : one);
  return found;
}
export const next = (all, otherwise) => (iter(all).length > 0 ? iter(all)[0] : otherwise);
export const any = (all) => iter(all).some(truth);
export const all = (every) => iter(every).every(truth);
export const sum = (all) => iter(all).reduce((total, one) => add(total, one), 0);

/** Which of two values comes first: numbers, text, or sequences of them. */
function compare(a, b) {
  if (isList(a) || a instanceof Tuple) {
    const [ones, others] = [iter(a), iter(b)];
    return ones.map((one, i) => compare(one, others[i])).find((sign) => sign !== 0) ?? 0;
  }
  return a < b ? -1 : Number(a > b);
}
export const sorted = (all, { key = (one) => one } = {}) => list(all).sort((one, other) => compare(key(one), key(other)));
/** Add a value to a heap, whose least value is first. */
export function heappush(heap, one) {
  let i = heap.push(one) - 1;
  for (; i > 0 && compare(one, heap[(i - 1) >> 1]) < 0; i = (i - 1) >> 1) heap[i] = heap[(i - 1) >> 1];
  heap[i] = one;
}
/** Take the least value of a heap. */
export function heappop(heap) {
  const [least, last] = [heap[0], heap.pop()];
  const n = heap.length;
  if (n === 0) return least;
  let i = 0;
  for (let child = 1; child < n; child = 2 * i + 1) {
    if (child + 1 < n && compare(heap[child + 1], heap[child]) < 0) child++;
    if (compare(last, heap[child]) <= 0) break;
    heap[i] = heap[child];
    i = child;
  }
  heap[i] = last;
  return least;
}
const extreme = (sign) =>
  function (...given) {
    const last = given[given.length - 1];
    const options = given.length > 1 && last?.constructor === Object ? given.pop() : {};
    const found = given.length > 1 ? given : iter(given[0]);
    if (found.length === 0) return options.default;
    const key = options.key ?? ((one) => one);
    return found.reduce((best, one) => (sign * compare(key(one), key(best)) > 0 ? one : best));
  };
export const min = extreme(-1);
export const max = extreme(1);
export const partial =
  (change, ...given) =>
  (...rest) => {
    const options = given[given.length - 1]?.constructor === Object ? given.slice(-1) : [];
    return change(...given.slice(0, given.length - options.length), ...rest, ...options.flatMap(Object.values));
  };

// Methods

export const join_ = (text, all) => iter(all).join(text);
export const removesuffix_ = (text, end) => (text.endsWith(end) ? text.slice(0, -end.length) : text);
export const removeprefix_ = (text, start) => (text.startsWith(start) ? text.slice(start.length) : text);
export const capitalize_ = (text) => text.charAt(0).toUpperCase() + text.slice(1).toLowerCase();
export const lower_ = (text) => text.toLowerCase();
export const replace_ = (text, old, other) => text.replaceAll(old, other);
export const encode_ = (text) => text;
export const items_ = (map) => [...map];
export const values_ = (map) => [...map.values()];
export const get_ = (map, key, otherwise = null) => (map.has(key) ? map.get(key) : otherwise);
export const append_ = (all, one) => all.push(one);
export const pop_ = (all) => all.pop();
export const tolist_ = (all) => (all.axes ? rowsOf(all).map(tolist_) : Array.prototype.slice.call(all));
export const round_ = (all, digits) => all.map((one) => round(one, digits));
export const any_ = (all) => all.some(truth);
export const copy_ = (all) => all.slice();
export const conjugate_ = (z) => new Complex(complex(z).real, neg(complex(z).imag));
export const index_ = (all, one) => all.findIndex((other) => eq(one, other));

// Functions

const size = unary(Math.abs);
export const abs = (a) => (a instanceof Complex ? np.hypot(a.real, a.imag) : size(a));
export const float = Number;
export const bool = Boolean;
export const int = (a) => Math.trunc(number(a));
export { makeComplex as complex };
const makeComplex = (real, imag) => (real instanceof Complex ? real : new Complex(real, imag));
const DEGREE = Math.PI / 180;
export const math = {
  ...Object.fromEntries(["sin", "cos", "tan", "acos", "asin", "atan2", "sqrt", "hypot", "floor", "ceil"].map((name) => [name, Math[name]])),
  pi: Math.PI,
  tau: 2 * Math.PI,
  dist: ([x, y], [a, b]) => Math.hypot(a - x, b - y),
  inf: Infinity,
  nan: NaN,
  isfinite: Number.isFinite,
  isnan: Number.isNaN,
  fmod: (a, b) => a % b,
  radians: (a) => a * DEGREE,
  degrees: (a) => a * (180 / Math.PI),
  copysign: (a, b) => (b < 0 || Object.is(b, -0) ? -Math.abs(a) : Math.abs(a)),
};
export const cmath = { exp: (z) => np.exp(complex(z)) };
/** A function of numbers that gives one or several, for each element of arrays: an array of each. */
export const elementwise =
  (change) =>
  (...given) => {
    const length = given.find(isList)?.length;
    if (length === undefined) return change(...given);
    const found = Array.from({ length }, (_, i) => change(...given.map((one) => (isList(one) ? one[i] : one))));
    if (length > 0 && typeof found[0] === "number") return array(found);
    return (found[0] ?? []).map((_, column) => filled([length], (i) => found[i][column]));
  };
// Words and statuses of the kernel, which are numbers there

/** The letters of a word. */
export const letters = (word) => name_of(Word, word).replace("EMPTY", "");
export const name_of = (members, value) => Object.keys(members).find((name) => members[name] === value);

// Text

/** The digits of a number with some decimals, ties to even as in C. */
function fixed(x, digits) {
  const text = Math.abs(x) < 1e21 ? x.toFixed(digits) : BigInt(x).toString() + (digits ? `.${"0".repeat(digits)}` : "");
  const exact = Math.abs(x) < 1e21 ? Math.abs(x).toFixed(Math.min(100, digits + 60)) : "";
  const rest = exact.split(".")[1]?.slice(digits) ?? "";
  if (!/^50*$/.test(rest)) return text;
  const down = exact.slice(0, exact.length - rest.length).replace(/\.$/, "");
  return "02468".includes(down.charAt(down.length - 1)) ? (x < 0 ? "-" : "") + down : text;
}

export function round(x, digits = 0) {
  return Number.isFinite(x) && digits < 100 ? Number(fixed(x, digits)) : x;
}

const exponent = (text) => text.replace(/e([+-])(\d)$/, "e$10$2");

/** A number with some significant digits and without trailing zeros, as %g writes it. */
function general(x, precision) {
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  const scientific = x.toExponential(precision - 1);
  const power = Number(scientific.slice(scientific.indexOf("e") + 1));
  if (power >= -4 && power < precision) {
    const text = fixed(x, precision - 1 - power);
    return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  }
  return exponent(scientific.replace(/\.?0+e/, "e"));
}

/** A value in a format of Python. */
export function format(value, spec) {
  const [, align, width, comma, precision, kind] = /^([<>]?)(\d*)(,?)(?:\.(\d+))?([a-z]?)$/.exec(spec);
  let text = typeof value === "string" ? value : formatted(value, kind, precision === undefined ? 6 : Number(precision));
  if (comma) text = text.replace(/\B(?=(\d{3})+(?!\d))/g, ",");
  const wide = Number(width);
  return align === "<" || (typeof value === "string" && align !== ">") ? text.padEnd(wide) : text.padStart(wide);
}
function formatted(x, kind, precision) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x < 0 ? "-inf" : "inf";
  if (kind === "f") return fixed(x, precision);
  if (kind === "e") return exponent(x.toExponential(precision));
  return kind === "g" ? general(x, precision || 1) : String(x);
}

/** A value as Python's `str` gives it; numbers are those with decimals. */
export function str(value) {
  if (typeof value !== "number") return value == null ? "None" : String(value);
  if (!Number.isFinite(value)) return formatted(value);
  const text = String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e16)) return exponent(value.toExponential());
  return Number.isInteger(value) ? `${Object.is(value, -0) ? "-0" : text}.0` : text;
}

export function repr(value) {
  if (typeof value === "string") return value.includes("'") && !value.includes('"') ? `"${value}"` : `'${value.replaceAll("'", "\\'")}'`;
  if (value instanceof Values || value instanceof Tuple) {
    const fields = value.constructor.fields.map((name) => `${name}=${repr(value[name])}`);
    return `${value.constructor.title}(${fields.join(", ")})`;
  }
  return str(value);
}
export const escape = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;").replaceAll("'", "&#x27;");

// Files

export const json = {
  dumps: (value, { indent = 0 } = {}) => written(plain(value), indent, "\n"),
};
/** A value as Python's json writes it; whole numbers have no decimals. */
function written(value, indent, line) {
  if (typeof value === "number") return str(value).replace(/\.0$/, "");
  if (value === null || typeof value !== "object") return JSON.stringify(value);
  const inner = indent ? line + " ".repeat(indent) : "";
  const parts = Array.isArray(value)
    ? value.map((one) => written(one, indent, inner))
    : Object.entries(value).map(([key, one]) => `${JSON.stringify(key)}: ${written(one, indent, inner)}`);
  const [open, close] = Array.isArray(value) ? "[]" : "{}";
  return parts.length === 0 ? open + close : open + inner + parts.join(indent ? `,${inner}` : ", ") + (indent ? line : "") + close;
}

export const io = { StringIO: () => ({ parts: [], getvalue() { return this.parts.join(""); } }) };
export const csv = {
  writer: (text) => ({
    writerow: (row) => text.parts.push(`${iter(row).map(str).join(",")}\n`),
    writerows: (all) => text.parts.push(...iter(all).map((row) => `${row.map(str).join(",")}\n`)),
  }),
};

/** Elements of XML. */
export const ElementTree = {
  Element: (tag, attributes) => ({ tag, attributes, text: null, children: [] }),
  SubElement(parent, tag, attributes) {
    const element = ElementTree.Element(tag, attributes);
    parent.children.push(element);
    return element;
  },
  indent() {},
  tostring: (element) => `<?xml version='1.0' encoding='UTF-8'?>\n${markup(element, "\n")}`,
};
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
function markup({ tag, attributes, text, children }, line) {
  const written_ = [...attributes].map(([name, value]) => ` ${name}="${escaped(value).replaceAll('"', "&quot;")}"`).join("");
  if (text !== null && text !== "") return `<${tag}${written_}>${escaped(text)}</${tag}>`;
  if (children.length === 0) return `<${tag}${written_} />`;
  const inner = `${line}  `;
  return `<${tag}${written_}>${children.map((child) => inner + markup(child, inner)).join("")}${line}</${tag}>`;
}
