"""Makes the numbers of `paper.py`: 50 digits from the paper's own equations, not from the project's closed forms.

Example 1 is in closed form in the paper (section 7). Example 2 follows the paper's own way: the first switch is the
root of (23) along the first arc, the second the crossing with the circle of radius 2 about (0, -1), both found
numerically. Run: python tests/golden/build_paper.py
"""

from mpmath import acos, asin, atan2, cos, findroot, mp, mpf, pi, sin, sqrt

mp.dps = 50


def example_1():
    tau1 = pi + asin(mpf(1) / 5) - asin(mpf(3) / 5)
    return tau1, sqrt(24) - sqrt(3), pi / 3


def example_2():
    x0, y0 = mpf("-0.53"), mpf("0.31")

    def left(t):
        return x0 * cos(t) + (y0 + 1) * sin(t), -x0 * sin(t) + (y0 + 1) * cos(t) - 1

    def off_curve(t):
        x, y = left(t)
        return x**2 - (-(y**2) + 3 * y + mpf(3) / 2 - sqrt(y**2 + 9 * y + mpf(9) / 4))

    tau1 = findroot(off_curve, mpf("0.5921"))
    xa, ya = left(tau1)

    def right(t):
        return xa * cos(t) - (ya - 1) * sin(t), xa * sin(t) + (ya - 1) * cos(t) + 1

    middle = findroot(lambda t: right(t)[0] ** 2 + (right(t)[1] + 1) ** 2 - 4, mpf("4.4428"))
    xb, yb = right(middle)
    return tau1, middle, atan2(-xb, yb + 1)


def admissible_2():
    """The control (29): right until the circle of radius 2 about (0, -1), then left."""
    x0, y0 = mpf("-0.53"), mpf("0.31")

    def right(t):
        return x0 * cos(t) - (y0 - 1) * sin(t), x0 * sin(t) + (y0 - 1) * cos(t) + 1

    first = findroot(lambda t: right(t)[0] ** 2 + (right(t)[1] + 1) ** 2 - 4, mpf("5.5867"))
    return first, acos((right(first)[1] + 1) / 2)


if __name__ == "__main__":
    for durations in (example_1(), example_2(), admissible_2()):
        print([mp.nstr(t, 20) for t in durations], mp.nstr(sum(durations), 20))
