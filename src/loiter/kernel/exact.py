"""Sums and products with their rounding errors (Dekker 1971, Knuth 1969), for results that need twice the digits."""

# Dekker's splitting factor, 2^27 + 1, halves the 53 digits of a double.
SPLITTER = 134217729.0


def two_sum(a: float, b: float) -> tuple[float, float]:
    """The rounded sum a + b, and its rounding error, exactly."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def split(a: float) -> tuple[float, float]:
    """A double as the sum of two of 26 digits."""
    c = SPLITTER * a
    high = c - (c - a)
    return high, a - high


def two_product(a: float, b: float) -> tuple[float, float]:
    """The rounded product a b, and its rounding error, exactly for |a|, |b| < 2^480."""
    p = a * b
    ah, al = split(a)
    bh, bl = split(b)
    return p, ((ah * bh - p) + ah * bl + al * bh) + al * bl


def beyond(x: float, y: float, R: float, k: float) -> float:
    """The difference of squares x^2 + (y - R) (y + R + k), with nearly full relative accuracy even near zero.

    With k = 2 it is rp^2 - (R + 1)^2: the squared distance from (0, -1) less the squared radius of the last circle of
    L. With k = -2 it is rm^2 - (R - 1)^2, the same for R about (0, 1). Near zero it is a small difference of large
    numbers, and T varies with its square root: in plain doubles T would lose half of its digits there.
    """
    s, es = two_sum(y, -R)
    t, et = two_sum(y, R)
    t, ek = two_sum(t, k)
    p, ep = two_product(s, t)
    q, eq = two_product(x, x)
    u, eu = two_sum(q, p)
    return u + (eu + (ep + eq + s * (et + ek) + t * es))


def square_beyond(a: float, b: float) -> float:
    """The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480."""
    p, e = two_product(a, a)
    return (p - b) + e
