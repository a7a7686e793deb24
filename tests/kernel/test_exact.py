"""Error-free sums and products, against rational arithmetic."""

from fractions import Fraction

from hypothesis import assume, given
from hypothesis import strategies as st

from loiter.kernel.exact import beyond, two_product, two_sum

numbers = st.floats(-1e15, 1e15, allow_subnormal=False).filter(lambda a: a == 0.0 or abs(a) > 1e-100)


@given(numbers, numbers)
def test_a_sum_and_its_error_are_exact(a, b):
    s, e = two_sum(a, b)
    assert s == a + b
    assert Fraction(s) + Fraction(e) == Fraction(a) + Fraction(b)


@given(numbers, numbers)
def test_a_product_and_its_error_are_exact(a, b):
    p, e = two_product(a, b)
    assert p == a * b
    assert Fraction(p) + Fraction(e) == Fraction(a) * Fraction(b)


near = st.floats(-1e-6, 1e-6)


@given(st.floats(-30.0, 30.0), st.floats(1.0, 30.0), st.sampled_from([2.0, -2.0]), near)
def test_a_difference_of_squares_keeps_its_digits_near_zero(y, R, k, off):
    """On the circle, and next to it: to 2^-100 of the terms, or full digits of the value."""
    square = -(y - R) * (y + R + k)
    assume(square >= 0.0)
    x = square**0.5 + off
    true = Fraction(x) ** 2 + (Fraction(y) - Fraction(R)) * (Fraction(y) + Fraction(R) + Fraction(k))
    terms = Fraction(x) ** 2 + 1
    assert abs(Fraction(beyond(x, y, R, k)) - true) <= abs(true) * Fraction(2) ** -51 + terms * Fraction(2) ** -98
