"""How often each type of Dubins path is the fastest entry, among random states, for section 12 of proof.md.

`python -m evidence.campaigns.types_of_entries --states 1000000` computes the times of all six words of three
pieces onto the clockwise circle, RLR and the other roots of LRL included, by plain formulas that share nothing with
the kernel. It compares the least with `loiter.min_time`. States are uniform in a disc of R + 6 turn radii.
"""

import argparse

import numpy as np

import loiter

# A word of three pieces counts as faster than the others if it is so by more than this share of 1 + T.
TIE = 1e-9

WORDS = ("LSL", "RSL", "LSR", "RSR", "RL", "LR", "LRL", "RLR")


def turn(point, centre, to, sense):
    """The angle in [0, 2 pi) from one point to another about (0, centre): clockwise for sense = 1."""
    a = np.arctan2(point[1] - centre, point[0])
    b = np.arctan2(to[1] - centre, to[0])
    return np.mod(sense * (a - b), 2.0 * np.pi)


def straight_words(x, y, R):
    """LSL, RSL, LSR, RSR: nan where a word does not exist."""
    zero = np.zeros_like(x)
    for first, last in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        c = np.sqrt(x * x + (y + first) ** 2 - 1.0)
        X = np.sqrt(R * (R + 2.0 * last))
        exists = c >= X if last > 0 else c <= X
        begin, end = (-last * c, zero), (-last * X, zero)
        time = turn((x, y), -first, begin, first) + np.abs(X - c) + turn(end, -last, (zero, R), last)
        yield np.where(exists, time, np.nan)


def arcs(x, y, R, first):
    """RL (first = -1) or LR (+1), the faster of both crossings."""
    last = -first
    square = x * x + (y + first) ** 2
    y1 = first * (square - (R + last) ** 2) / 4.0
    x1 = np.sqrt(square - (y1 + first) ** 2)
    times = []
    for side in (-1.0, 1.0):
        crossing = (side * x1, y1)
        times.append(turn((x, y), -first, crossing, first) + turn(crossing, -last, (np.zeros_like(x), R), last))
    return np.fmin(*times)


def three_arcs(x, y, R, first):
    """LRL (first = 1) or RLR (-1), the faster of both roots of (P2)."""
    K, k = R * (R + 2.0 * first), x * x + (y + first) ** 2 - 1.0
    h, d = 0.5 * (K + k), 0.25 * (K - k)
    fastest = np.full_like(x, np.nan)
    for sign in (-1.0, 1.0):
        s2 = (h + sign * np.sqrt(h * h - 3.0 * d * d)) / 6.0
        s = np.sqrt(s2)
        c = np.sqrt(1.0 - s2)
        w = (16.0 * s2 - (k - K)) / (8.0 * s)
        a, b = ((3.0 * s - w) * c, first * (3.0 * s - w) * s), ((s - w) * c, -first * (s - w) * s)
        time = turn((x, y), -first, a, first) + turn(a, first, b, -first)
        fastest = np.fmin(fastest, time + turn(b, -first, (np.zeros_like(x), R), first))
    return fastest


def times(x, y, R):
    """The times of the words onto the clockwise circle, nan where one does not exist; rows as in `WORDS`."""
    with np.errstate(invalid="ignore", divide="ignore"):
        rows = [*straight_words(x, y, R), arcs(x, y, R, -1), arcs(x, y, R, 1)]
        return np.array([*rows, three_arcs(x, y, R, 1), three_arcs(x, y, R, -1)])


def states(count, seed):
    """Random states and radii: a fifth at R = 1, otherwise R up to 30, with its logarithm uniform."""
    rng = np.random.default_rng(seed)
    R = np.where(rng.random(count) < 0.2, 1.0, np.exp(rng.uniform(0.0, np.log(30.0), count)))
    distance, angle = (R + 6.0) * np.sqrt(rng.random(count)), rng.uniform(-np.pi, np.pi, count)
    return distance * np.cos(angle), distance * np.sin(angle), R


def main():
    """Print the share of each word, for a fixed direction and for either."""
    parser = argparse.ArgumentParser(
        prog="python -m evidence.campaigns.types_of_entries", description=__doc__.partition("\n")[0]
    )
    parser.add_argument("--states", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    x, y, R = states(options.states, options.seed)
    clockwise = times(x, y, R)
    # The mirror image: onto the counter-clockwise circle, with L and R exchanged.
    counter = times(x, -y, R)
    least = np.nanmin(clockwise, axis=0)
    kernel = loiter.min_time(x, y, R, turn="cw")
    print(f"largest difference from the kernel: {np.max(np.abs(least - kernel) / (1.0 + least)):.2g} of 1 + T")
    print("| word | clockwise only | either, ends clockwise | either, ends counter-clockwise |\n|---|---|---|---|")
    best = np.fmin(least, np.nanmin(counter, axis=0))
    mirror = str.maketrans("LR", "RL")
    for i, word in enumerate(WORDS):
        opposite = WORDS.index(word.translate(mirror))
        counts = [
            np.sum(clockwise[i] <= least + TIE * (1.0 + least)),
            np.sum(clockwise[i] <= best + TIE * (1.0 + best)),
            np.sum(counter[opposite] <= best + TIE * (1.0 + best)),
        ]
        print(f"| {word} | " + " | ".join(f"{count:,}" for count in counts) + " |")
    margin = np.nanmin(np.where(np.isnan(clockwise[-1]), np.nan, clockwise[-1] / least))
    print(f"RLR exists at {np.sum(~np.isnan(clockwise[-1])):,} states; the least of T(RLR)/T is {margin:.4f}")


if __name__ == "__main__":
    main()
