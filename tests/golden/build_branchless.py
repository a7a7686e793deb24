"""Coefficients of `compiled/branchless.py`: Chebyshev interpolation in 60 digits, then rounded to doubles.

Run `python tests/golden/build_branchless.py` to print them, with the largest error that each polynomial leaves.
"""

from mpmath import atan, chop, cos, linspace, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt, tan

mp.dps = 60


def interpolated(function, end, terms):
    """Coefficients of the polynomial in z that equals `function` at the Chebyshev nodes of [0, end]."""
    nodes = [end / 2 * (1 + cos(pi * (2 * k + 1) / (2 * terms))) for k in range(terms)]
    powers = matrix(terms, terms)
    for i, z in enumerate(nodes):
        for j in range(terms):
            powers[i, j] = z**j
    return [chop(c) for c in lu_solve(powers, matrix([function(z) for z in nodes]))]


# atan q = q + q z A(z), sin q = q + q z S(z), cos q = 1 - z/2 + z^2 C(z), with z = q^2.
CASES = {
    "ATAN": (lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, tan(pi / 8) ** 2, 12, lambda z: z),
    "SIN": (lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, (pi / 4) ** 2, 7, lambda z: z),
    "COS": (lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, (pi / 4) ** 2, 6, lambda z: z**2),
}

if __name__ == "__main__":
    for name, (function, end, terms, weight) in CASES.items():
        coefficients = [float(c) for c in interpolated(function, end, terms)]
        grid = linspace(mpf("1e-4"), end, 500)
        error = max(
            abs(weight(z) * (function(z) - sum(mpf(c) * z**j for j, c in enumerate(coefficients)))) for z in grid
        )
        print(f"{name} = (  # leaves {nstr(error, 2)}")
        for c in coefficients:
            print(f"    {c!r},")
        print(")")
