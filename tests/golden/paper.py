"""Numbers of the paper's section 7, to more digits than it prints; `build_paper.py` makes them from its equations."""

from typing import NamedTuple


class Example(NamedTuple):
    name: str
    x: float
    y: float
    words: list[str]
    durations: tuple[float, float, float]
    time: float
    printed: float


# fmt: off
EXAMPLES = [
    Example(
        "example 1", 4.0, 4.0, ["RSL", "RSR"],
        (2.6994494655868396431, 3.1669286779974789029, 1.0471975511965977462), 6.9135756947809162921, 6.9136,
    ),
    Example(
        "example 2", -0.53, 0.31, ["LRL"],
        (0.5921188866376514818, 4.4428067970270394779, 0.34294135913795831004), 5.3778670428026492697, 5.3779,
    ),
]
# fmt: on

# The admissible control (29) of example 2: its two durations.
ADMISSIBLE = (5.5866509748737835666, 0.43853427796155760216)
