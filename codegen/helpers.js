// What Python has and JavaScript has not: the first of two that tie, and quotients rounded down. Integers are doubles
// without fraction, of up to 53 bits; &, |, ~ and shifts by a constant take 32.

/** @type {(a: number, b: number) => number} */
export const min_real = (a, b) => (b < a ? b : a);

/** @type {(a: number, b: number) => number} */
export const max_real = (a, b) => (b > a ? b : a);

export const [min_integer, max_integer] = [min_real, max_real];

/** @type {(a: number, b: number) => number} */
export const integer_quotient = (a, b) => Math.floor(a / b);

/** @type {(a: number, b: number) => number} */
export const integer_modulo = (a, b) => a - Math.floor(a / b) * b;

/** @type {(bits: number) => number} */
const power_of_two = (bits) => (bits < 31 ? 1 << bits : 1073741824 * power_of_two(bits - 30));

/** @type {(a: number, bits: number) => number} */
export const shift_left = (a, bits) => a * power_of_two(bits);

/** @type {(a: number, bits: number) => number} */
export const shift_right = (a, bits) => Math.floor(a / power_of_two(bits));

/** @type {(a: number, b: number) => number} */
export function real_modulo(a, b) {
    const rest = a % b;
    if (rest === 0) {
        return b < 0 ? -0 : 0;
    }
    return rest < 0 !== b < 0 ? rest + b : rest;
}

/** @type {(a: number) => boolean} */
export const isfinite = Number.isFinite;

/** What is too large for 32 bits, or nan, becomes the largest or least of them. @type {(a: number) => number} */
export const integer_of = (a) => (a >= 2147483647 ? 2147483647 : a > -2147483647 ? Math.trunc(a) + 0 : -2147483647);

/** @type {(count: number) => number[]} */
export const range = (count) => Array.from({ length: count }, (_, i) => i);

/** The elements in the order of a function of them. @type {<T>(list: T[], key: (one: T) => number) => T[]} */
export const sorted = (list, key) => [...list].sort((a, b) => key(a) - key(b));
