"""The seven figures of the paper, computed by the kernel at R = 1, *either*."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from math import ceil, pi
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from loiter.arrays import control
from loiter.kernel.adjoint import adjoint, turn_adjoint
from loiter.kernel.entry import Entry, duration
from loiter.kernel.motion import flow
from loiter.kernel.rebinding import Function, rebound
from loiter.kernel.still_air.switching_curves import last_arc_abscissa, switching_abscissa
from loiter.kernel.still_air.synthesis import optima, ranked
from loiter.kernel.words import Side, Word, controls
from loiter.planning.model import CONTROLS
from loiter.plot.picture import CHORD_RAD, COLOURS, MARK, MARKS, draw_arrow

Floats = NDArray[np.float64]

# Starts of the examples of section 7.
EXAMPLE_1, EXAMPLE_2 = (4.0, 4.0), (-0.53, 0.31)

# Fig. 1: radii of the circles about each centre; 2 is the radius of the last arc.
RADII = (0.5, 1.0, 1.5, 2.0)

# Fig. 3: a start on the axis, one above and one below it, far enough from the centre for a straight piece, (24).
SINGULAR_STARTS = ((-4.5, 0.0), (-3.5, 2.0), (-1.0, -3.5))

# Fig. 4: half the side of the map, and the number of its cells: even, so that none lies on y = 0, where controls tie.
MAP_REACH, MAP_CELLS = 3.0, 600
# Positions of the labels of u: one in each region.
PLACES = ((1.6, 1.6), (-0.75, 0.35), (-0.75, -0.35), (1.6, -1.6))
WHITE, GREY = "#ffffff", "#b8b8b8"

LETTERS = {u: letter for letter, u in CONTROLS.items()}
STRAIGHT = "u = 0"
NAMES = {1: "u = +1", 0: STRAIGHT, -1: "u = −1"}
AID: dict[str, Any] = {"color": "#909090", "linewidth": 1.0}


class TrajectoryPiece(NamedTuple):
    """Points (n,) of a piece of a trajectory in the reduced plane, and the control flown along it."""

    u: int
    x: Floats
    y: Floats


class PaperFigure(NamedTuple):
    """A figure of the paper: its number, its caption and the function that draws it."""

    number: int
    caption: str
    draw: Callable[[], Figure]


def trajectory(x: float, y: float, maneuver: Entry) -> list[TrajectoryPiece]:
    """The pieces of a maneuver flown exactly from the reduced state (x, y)."""
    pieces = []
    for letter, t in zip(Word(maneuver.word).letters, (maneuver.t1, maneuver.t2, maneuver.t3), strict=False):
        u = CONTROLS[letter]
        pieces.append(piece(x, y, u, t))
        x, y = flow(x, y, u, t)
    return pieces


def piece(x: float, y: float, u: int, t: float) -> TrajectoryPiece:
    """A piece of duration t with control u from (x, y); its chords differ from it by less than the width of a line."""
    times = np.linspace(0.0, t, 3 + ceil(t / CHORD_RAD))
    return TrajectoryPiece(u, *np.broadcast_arrays(*_flow_arrays()(x, y, u, times)))


@cache
def _flow_arrays() -> Function:
    return rebound(flow, {"sin": np.sin, "cos": np.cos})


def admissible() -> Entry:
    """The control (29) of example 2: right, then left, onto the clockwise circle."""
    return next(m for m in ranked(*EXAMPLE_2, 1.0, Side.CW, 0.0) if m.word == Word.RL)


def figure_1() -> Figure:
    """Draw the circles on which the state turns, a panel for each sense."""
    figure = Figure(figsize=(9.0, 4.8), layout="constrained")
    for u, axes in zip((1, -1), figure.subplots(1, 2), strict=True):
        for radius in RADII:
            _draw_piece(axes, piece(0.0, radius - u, u, 2.0 * pi))
        axes.plot([0.0], [-float(u)], "+", color="black", markersize=9, gid="centre")
        _note(axes, _point((0.0, -u)), 0.0, -float(u), (0, -15), ha="center")
        axes.set_title(f"{NAMES[u]}: {'clockwise' if u > 0 else 'counter-clockwise'}")
        _frame(axes)
    return figure


def figure_2() -> Figure:
    """Draw the unit circle of the adjoint, and the arc of psi between two switches, a panel for each sense."""
    figure = Figure(figsize=(9.0, 3.9), layout="constrained")
    x, y = EXAMPLE_2
    # The middle piece of example 2, and that of its mirror image.
    for side, axes in zip((1, -1), figure.subplots(1, 2), strict=True):
        best, *_ = optima(x, side * y, 1.0, side, 0.0)
        _draw_adjoint(axes, x, side * y, best)
    return figure


def _draw_adjoint(axes: Axes, x: float, y: float, maneuver: Entry) -> None:
    lam, psi1, psi2 = adjoint(x, y, 1.0, maneuver)
    _, u, _ = controls(maneuver.word)
    psi, middle = turn_adjoint(psi1, psi2, -u, maneuver.t1), maneuver.t2
    times = np.linspace(0.0, middle, 3 + ceil(middle / CHORD_RAD))
    arc = [turn_adjoint(*psi, u, t) for t in times.tolist()]
    first_switch, *_, second_switch = arc
    axes.plot(*np.array([turn_adjoint(1.0, 0.0, u, t) for t in np.linspace(0.0, 2.0 * pi, 181)]).T, **AID, gid="circle")
    axes.axvline(lam, linestyle=(0, (4, 3)), **AID, gid="lambda")
    _draw_piece(axes, TrajectoryPiece(u, *np.array(arc).T))
    for name, (x1, x2) in (("first switch", first_switch), ("second switch", second_switch)):
        _mark(axes, x1, x2, gid="switch", **MARKS["switch"])
        _note(axes, name, x1, x2, (8, 8 if x2 > 0.0 else -16))
    axes.set_title(f"{NAMES[u]}: {middle:.4f} between switches")
    _note(axes, "ψ₁ = λ", lam, 0.0, (5, -4))
    _frame(axes, "ψ₁", "ψ₂")
    axes.set_xlim(-1.3, 1.7)


def figure_3() -> Figure:
    """Draw entries with a straight piece: it lies on y = 0 and is flown to the right."""
    figure, axes = _single()
    axes.axhline(0.0, **AID, zorder=0)
    for start in SINGULAR_STARTS:
        _draw_flights(axes, start, optima(*start, 1.0, Side.EITHER, 0.0))
    axes.set_title("Singular trajectories: u = 0 on y = 0 only")
    _legend(axes, (1, 0, -1))
    return figure


def figure_4() -> Figure:
    """Draw the optimal control as a function of the state."""
    figure, axes = _single()
    line = (np.arange(MAP_CELLS) + 0.5) / MAP_CELLS * 2.0 * MAP_REACH - MAP_REACH
    u = control(line[np.newaxis, :], line[:, np.newaxis])
    colours = ListedColormap([WHITE, GREY])
    axes.pcolormesh(line, line, u, cmap=colours, vmin=-1.0, vmax=1.0, rasterized=True, gid="control")
    _draw_boundaries(axes)
    for x, y in PLACES:
        axes.text(x, y, NAMES[int(control(x, y))], ha="center", va="center", fontsize=11, gid="label")
    for end in (1.0, -1.0):
        _mark(axes, 0.0, end, gid="end", **MARKS["join"])
    _frame(axes)
    axes.grid(visible=False)
    axes.set(xlim=(-MAP_REACH, MAP_REACH), ylim=(-MAP_REACH, MAP_REACH), title="Optimal synthesis")
    patches = [Patch(facecolor=colour, edgecolor="black", label=NAMES[u]) for u, colour in ((1, GREY), (-1, WHITE))]
    _legend_below(axes, [*patches, *_labelled(axes)])
    return figure


def _draw_boundaries(axes: Axes) -> None:
    """Draw the ray of straight flight, the last arcs (27), the switching curve (23), and the rest of the axis."""
    y = 0.5 - 0.5 * np.cos(np.linspace(0.0, pi, 181))  # dense at both ends, where the curves are steep
    y_both = np.concatenate([-y[::-1], y])
    corner = last_arc_abscissa(0.0)
    arc = [last_arc_abscissa(abs(v)) for v in y_both.tolist()]
    curve = [switching_abscissa(abs(v), 1.0) for v in y_both.tolist()]
    axes.plot([-MAP_REACH, corner], [0.0, 0.0], color="black", linewidth=4.0, gid="straight", label=STRAIGHT)
    axes.plot(arc, y_both, color="black", linewidth=1.8, gid="last arc", label="last arc (27), T jumps")
    axes.plot(curve, y_both, "--", color="black", linewidth=1.8, gid="switching curve", label="switching curve (23)")
    axes.plot([corner, MAP_REACH], [0.0, 0.0], ":", color="black", linewidth=1.4, gid="tie", label="either sign")


def figure_5() -> Figure:
    """Draw the two optimal trajectories of example 1."""
    maneuvers = optima(*EXAMPLE_1, 1.0, Side.EITHER, 0.0)
    best, *_ = maneuvers
    figure, axes = _single(5.8)
    _draw_flights(axes, EXAMPLE_1, maneuvers)
    axes.set_title(f"Two optimal trajectories from {_point(EXAMPLE_1)}, T = {duration(best):.4f}")
    _legend(axes, (1, 0, -1))
    return figure


def figure_6() -> Figure:
    """Draw the trajectory of the control (29) of example 2, which is admissible but not optimal."""
    return _example_2(admissible(), "Admissible, not optimal")


def figure_7() -> Figure:
    """Draw the optimal trajectory of example 2."""
    [best] = optima(*EXAMPLE_2, 1.0, Side.EITHER, 0.0)
    return _example_2(best, "Optimal")


def _example_2(maneuver: Entry, what: str) -> Figure:
    figure, axes = _single(5.6)
    y = 0.5 - 0.5 * np.cos(np.linspace(0.0, pi, 181))
    curve = [switching_abscissa(v, 1.0) for v in y.tolist()]
    arc = [last_arc_abscissa(v) for v in y.tolist()]
    axes.plot(curve, y, linestyle=(0, (4, 3)), gid="switching curve", label="switching curve (23)", **AID)
    axes.plot(arc, y, gid="last arc", label="last arc (27)", **AID)
    _draw_flights(axes, EXAMPLE_2, [maneuver])
    axes.set_title(f"{what}, from {_point(EXAMPLE_2)}: T = {duration(maneuver):.4f}")
    _legend(axes, (1, -1))
    return figure


def _point(state: tuple[float, float]) -> str:
    x, y = state
    return f"({x:g}, {y:g})".replace("-", "−")


def _single(height: float = 6.4) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(6.4, height), layout="constrained")
    axes = figure.add_subplot()
    _frame(axes)
    return figure, axes


def _frame(axes: Axes, x: str = "x", y: str = "y") -> None:
    axes.set_aspect("equal")
    axes.grid(color="#e6e6e6", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.margins(0.08)
    axes.set_xlabel(x)
    axes.set_ylabel(y, rotation=0)


def _draw_flights(axes: Axes, start: tuple[float, float], maneuvers: Sequence[Entry]) -> None:
    """Draw trajectories from one start, with start, switches and ends marked."""
    for maneuver in maneuvers:
        x, y = start
        for i, part in enumerate(trajectory(x, y, maneuver)):
            if i > 0:
                _mark(axes, x, y, gid="switch", **MARKS["switch"])
            _draw_piece(axes, part)
            *_, x = part.x.tolist()
            *_, y = part.y.tolist()
        _mark(axes, x, y, gid="end", **MARKS["join"])
    _mark(axes, *start, gid="start", **START)


START: dict[str, Any] = {"marker": "s", "markersize": 7, "markerfacecolor": "black"}


def _mark(axes: Axes, x: float, y: float, **style: Any) -> None:
    axes.plot([x], [y], **MARK | {"zorder": 5} | style)


def _note(axes: Axes, text: str, x: float, y: float, offset: tuple[float, float], **style: Any) -> None:
    axes.annotate(text, (x, y), xytext=offset, textcoords="offset points", fontsize=9, **style)


def _draw_piece(axes: Axes, part: TrajectoryPiece) -> None:
    """Draw a piece in the colour of its control, with an arrow in the middle."""
    colour, i = COLOURS[LETTERS[part.u]], len(part.x) // 2
    axes.plot(part.x, part.y, color=colour, linewidth=2.2, zorder=3, gid=f"piece {LETTERS[part.u]}")
    draw_arrow(axes, part.x, part.y, i, colour)


def _legend(axes: Axes, controls_flown: Sequence[int]) -> None:
    """Draw a legend of the controls flown, the marks, and everything with a label."""
    handles = [Line2D([], [], color=COLOURS[LETTERS[u]], linewidth=2.2, label=NAMES[u]) for u in controls_flown]
    marks = {"start": START, "switch": MARKS["switch"], "end": MARKS["join"]}
    handles += [Line2D([], [], **MARK | {"label": name} | style) for name, style in marks.items()]
    _legend_below(axes, [*handles, *_labelled(axes)])


def _labelled(axes: Axes) -> list[Line2D]:
    # matplotlib's own labels begin with an underscore.
    return [line for line in axes.lines if not str(line.get_label()).startswith("_")]


def _legend_below(axes: Axes, handles: Sequence[Any]) -> None:
    # Below the picture the legend hides no curve.
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3, fontsize="small")


FIGURES = (
    PaperFigure(
        1,
        "Turning at the limit. The reduced state moves on circles, one radian a unit of time: clockwise about (0, -1) "
        "while the vehicle turns left (u = +1), counter-clockwise about (0, 1) while it turns right (u = -1).",
        figure_1,
    ),
    PaperFigure(
        2,
        "The adjoint between two switches. It stays on the unit circle and to the left of psi1 = lambda, so it takes "
        "the longer arc from one switch to the other: more than pi. The arcs shown are those of "
        "the middle piece of example 2 and, beside it, of its mirror image.",
        figure_2,
    ),
    PaperFigure(
        3,
        "Entries with a straight piece. On it y = 0: the vehicle flies along a line through the centre of the circle. "
        "It peels off at (-sqrt 3, 0), equally fast to either side.",
        figure_3,
    ),
    PaperFigure(
        4,
        "The optimal control at every state. Turn left in the grey, right in the white, fly straight on the black ray. "
        "The control changes across the switching curve, across the last arcs, where the least time jumps, and across "
        "the axis, right of the ray of which both signs are optimal.",
        figure_4,
    ),
    PaperFigure(
        5,
        "Example 1. Two entries from one start, equally fast: they separate at the end of the straight piece, and "
        "hold the circle in opposite directions.",
        figure_5,
    ),
    PaperFigure(
        6,
        "Example 2 with one switch. The vehicle turns right by almost a full turn, then left along the last arc. It "
        "arrives, but later than possible.",
        figure_6,
    ),
    PaperFigure(
        7,
        "Example 2 at its best. Left first, to the switching curve, then right to the last arc, then left along it.",
        figure_7,
    ),
)
