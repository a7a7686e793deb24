"""What the fastest entry in wind costs the kernel: compiled, and as plain Python."""

from itertools import cycle
from math import cos, sin

import numba
import pytest

from loiter.kernel.drift import fastest
from loiter.kernel.rebinding import rebound
from loiter.verify.met import scenes


@pytest.mark.parametrize("finish", [numba.njit, lambda function: function], ids=["compiled", "plain"])
def test_fastest(benchmark, finish):
    solve = rebound(fastest, finish=finish)
    arguments = cycle(
        (
            s.start.east,
            s.start.north,
            cos(s.start.angle),
            sin(s.start.angle),
            s.radius,
            int(s.side),
            s.wind_east,
            s.wind_north,
        )
        for s in scenes(300, 0)
    )
    solve(*next(arguments))
    benchmark.pedantic(lambda: solve(*next(arguments)), rounds=300)
