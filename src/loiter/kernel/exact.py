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


def beyond_circles(x: float, y: float, R: float) -> tuple[float, float, float]:
    """The squared distances rp^2 - (R + 1)^2, rm^2 - (R - 1)^2 and rp^2 - (R - 3)^2 beyond three circles.

    They are `beyond` with R and 2, R and -2, 2 - R and 2. The last is the sum u + d + low, with an error of third order
    only: at R = 1 + 2e-14 there are doubles next to (-sqrt(3), 0) where it is 8e-32, and where T would lose 1e-9 for
    the terms that `beyond` leaves out. The others differ from it by -8 (R - 1) and -4 (y + R - 2); for them an error of
    second order is enough, since next to their circles a single arc replaces the words that depend on them.
    """
    s, es = two_sum(y, R - 2.0)
    t, et = two_sum(y, 2.0 - R)
    t, ek = two_sum(t, 2.0)
    e, ee = two_sum(et, ek)
    p, ep = two_product(s, t)
    q, eq = two_product(x, x)
    v, ev = two_product(s, e)
    w, ew = two_product(t, es)
    u, eu = two_sum(q, p)
    a, ea = two_sum(ep, eq)
    b, eb = two_sum(v, w)
    c, ec = two_sum(a, b)
    d, ed = two_sum(eu, c)
    low = (es * e + s * ee) + ((ev + ew) + ((ea + eb) + (ec + ed)))
    f, ef = two_sum(u, -8.0 * (R - 1.0))
    g, eg = two_sum(u, -4.0 * s)
    return f + (ef + d), g + ((eg + d) - 4.0 * es), (u + d) + low


def square_beyond(a: float, b: float) -> float:
    """The difference a^2 - b with nearly full relative accuracy even near zero, for |a| < 2^480."""
    p, e = two_product(a, a)
    return (p - b) + e
