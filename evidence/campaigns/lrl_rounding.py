"""The terms of lemma 12 of bridging.md: by how much LRL can be computed later than it is, beside the bounds there.

`python -m evidence.campaigns.lrl_rounding` prints, for each term, its bound there and its largest value at pairs of
sigma and q that cover all states of LRL, in units of 2^-53. The terms have the absolute values of all errors of first
order, each as large as the document says.
"""

from __future__ import annotations

from typing import NamedTuple

import flint
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# The bounds in the table of lemma 12, in units of 2^-53, and of their sum.
BOUNDS = {
    "first rotation": 128.0,
    "vector to P0, middle": 100.0,
    "vector to the crossing, middle": 211.0,
    "the rotation of the middle arc": 3.0,
    "last rotation": 248.0,
    "T_B": 1493.0,
    "total_angle": 80.0,
}
LATEST = 2300.0


class Geometry(NamedTuple):
    """A switch of LRL: sigma = sin(alpha) and c = cos(alpha), q, and what follows from them; r is r_m there."""

    sigma: Array
    c: Array
    q: Array
    t: Array
    k: Array
    d: Array
    w: Array
    s: Array
    m: Array
    ya: Array
    yb: Array
    rp: Array
    r: Array
    R: Array
    root: Array
    gap: Array
    v: Array


def geometry(count: int) -> Geometry:
    """The switches at `count` squared values of q and of sigma, more of them next to sigma = 1, where c vanishes."""
    q = np.linspace(2.0, 2.0 + np.sqrt(3.0), count)[:, None]
    least = 3.0 / (q * q - 1.0)
    c2 = (1.0 - least) * np.linspace(0.0, 1.0, count)[None, :] ** 3
    sigma2 = 1.0 - np.maximum(c2, 1e-14)
    sigma, c, t = np.sqrt(sigma2), np.sqrt(1.0 - sigma2), 4.0 - q
    root = np.maximum(sigma2 * (4.0 * q - 1.0 - q * q), 0.0)
    w, k = 2.0 * (1.0 - sigma2), (t * t - 1.0) * sigma2
    gap = 3.0 * w + root
    return Geometry(
        sigma=sigma,
        c=c,
        q=q,
        t=t,
        k=k,
        d=2.0 * sigma2 * (q - 2.0),
        w=w,
        s=2.0 * sigma2,
        m=c / sigma,
        ya=sigma2 * (3.0 - q),
        yb=sigma2 * (q - 1.0),
        rp=np.sqrt(1.0 + k),
        r=np.sqrt(c * c + sigma2 * (q - 2.0) ** 2),
        R=np.sqrt(1.0 + sigma2 * (q * q - 1.0)) - 1.0,
        root=root,
        gap=gap,
        v=(gap * gap - root * root) / 3.0,
    )


def bracket(at: Geometry) -> Array:
    """The bound of B, by the residual of the quadratic (B6)."""
    e = (7.0 * at.gap**2 - 3.0 * at.root**2) / (at.gap + at.root)
    coarse = 2.0 * (at.gap**2 + at.root**2 + at.root * e) / 3.0 + 6.4 * at.gap * at.w + 6.3 * at.v
    near = at.w * (e + 6.4 * at.gap + 11.4 * (at.gap + at.root))
    return 1.01 * np.minimum(coarse, near) / (at.t * at.s * at.s)


def terms(at: Geometry) -> dict[str, Array]:
    """The terms of lemma 12, in the order of its table."""
    size = 1.0 + at.t
    e = (7.0 * at.gap**2 - 3.0 * at.root**2) / (at.gap + at.root)
    of_a = 6.0 + e / (3.0 * at.s)
    of_m = 0.5 * (of_a + 1.0) + 1.0
    of_k = 3.0 + 2.0 * np.maximum(at.k, 0.0)
    of_t = (np.abs(at.t**2 - 1.0) * (of_a + 1.0) + of_k / at.sigma**2 + at.t**2) / (2.0 * at.t) + at.t
    of_size, of_d = of_t + size, 3.0 * at.d

    def turned(x: Array, y: Array, of_x: Array, of_y: Array) -> Array:
        return (of_x * np.abs(y) + of_y * np.abs(x)) / (x * x + y * y)

    x = at.m * at.k
    of_x = np.abs(x) * (of_m + 1.0) + at.m * of_k
    upright = at.k + size
    first = turned(x, upright, of_x, of_k + of_size + np.abs(upright)) + 4.0
    low = 0.5 * (at.w + at.d)
    middle = turned(x, low * size, of_x, 0.5 * size * of_d + 2.0 * low * size + low * of_size)
    y = size * at.yb
    of_y = of_k + size * of_d + at.d * of_size + at.d * size + y
    end = at.m * y
    of_end = at.m * of_y + end * (of_m + 1.0)
    high = 0.5 * np.abs(at.w - at.d)
    other = turned(end, high * size, of_end, 0.5 * size * (of_d + 2.0 * high) + high * (of_size + size))
    last = turned(end, y + size, of_end, of_y + of_size + y + size) + 3.0
    B = bracket(at)
    beside = at.sigma * (at.q - 2.0) * B / (at.c * (at.q - 1.0))
    shifted = 0.25 * at.s * B * at.m * (np.abs(at.ya) + at.yb) / at.r**2
    crossing = beside * (np.abs(at.yb - 1.0) / at.r**2 + (at.yb + 1.0) / (at.R + 1.0) ** 2)
    values = first, middle, other, np.full_like(first, 3.0), last, shifted + crossing, np.full_like(first, 80.0)
    return dict(zip(BOUNDS, values, strict=True))


def identity() -> bool:
    """Whether x^2 (K - 3 y1)^2 - x1^2 (k - 3 y)^2 = -d rm^2 Q/2, from which (B4) follows."""
    y, d, k = flint.fmpz_mpoly_ctx.get(["y", "d", "k"], flint.Ordering.lex).gens()
    K, y1, s, h = k + 4 * d, y + d, 2 * y + d, k + 2 * d
    left = (k - y**2 - 2 * y) * (K - 3 * y1) ** 2 - (K - y1**2 - 2 * y1) * (k - 3 * y) ** 2
    return bool(2 * left == -d * (k + 1 - 4 * y) * (3 * s**2 - 2 * h * s + d**2))


def main() -> None:
    """Print the terms beside their bounds, and the largest sum."""
    found = terms(geometry(1000))
    for name, values in found.items():
        print(f"{name:32} {BOUNDS[name]:7.0f} {values.max():7.1f}")
    total = sum(found.values(), np.zeros(()))
    print(f"{'sum':32} {sum(BOUNDS.values()):7.0f} {total.max():7.1f}")
    print(f"identity of (B4): {identity()}")


if __name__ == "__main__":
    main()
