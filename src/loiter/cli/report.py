"""What `loiter plan` prints: tables for people, JSON for programs."""

import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict

from rich.console import Console, RenderableType
from rich.table import Table
from rich.text import Text

from loiter.planning.maneuver import Maneuver

ACTIONS = {"L": "turn left", "S": "fly straight", "R": "turn right"}

# Two durations that are equal in theory differ by rounding, near 1e-15 of themselves in near and 1e-14 in far scenes.
SAME_TIME = 1e-12

# A miss is told from this share of the radius on: a metre on a kilometre.
SHOWN = 1e-3

# No line is longer; rich would cut or wrap at the width of the window, and numbers must stay whole.
WIDEST = 1000


def print_json(document: dict[str, object]) -> None:
    """Print one JSON object."""
    json.dump(document, sys.stdout, indent=2, allow_nan=False)
    sys.stdout.write("\n")


def answer(best: Sequence[Maneuver], others: Sequence[Maneuver]) -> dict[str, object]:
    """The first of `best` as plain values; its `alternatives` are the rest of `best`, then `others`."""
    first, *rest = best
    alternatives = [described(m) | {"later_s": m.duration_s - first.duration_s} for m in (*rest, *others)]
    return described(first) | {"alternatives": alternatives}


def described(maneuver: Maneuver) -> dict[str, object]:
    """A maneuver as plain values, for JSON."""
    return {
        "duration_s": maneuver.duration_s,
        "length_m": maneuver.length_m,
        "word": maneuver.word,
        "turn": maneuver.turn.value,
        "join": asdict(maneuver.join),
        "miss_m": maneuver.miss_m,
        "segments": [asdict(segment) for segment in maneuver.segments],
    }


def print_tables(best: Sequence[Maneuver], others: Sequence[Maneuver], *, everything: bool) -> None:
    """Print the first of `best`, or with `everything` each, and what the other direction costs."""
    lines: list[RenderableType] = []
    for maneuver in best if everything else best[:1]:
        lines.append(Text(headline(maneuver), style="bold"))
        if maneuver.segments:
            lines += [table(maneuver), peel_off(maneuver)]
        if maneuver.miss_m > SHOWN * maneuver.orbit.radius_m:
            lines.append(f"Ends {maneuver.miss_m:.3g} m off the point of joining, within the tolerance.")
    lines.append(other_direction(best, others))
    if len(best) > 1 and not everything:
        lines.append(f"{len(best)} maneuvers are optimal; --all shows each.")
    write(*lines)


def write(*lines: RenderableType) -> None:
    """Write lines and tables to standard output, all at once and none of them cut to the width of a window."""
    console = Console(highlight=False, width=WIDEST)
    with console.capture() as capture:
        for line in lines:
            console.print(line)
    sys.stdout.write(capture.get())


def headline(maneuver: Maneuver) -> str:
    """One line: the word, the direction, the time to join and the distance."""
    if not maneuver.segments:
        return f"On the circle already, {maneuver.turn.described}: nothing to fly."
    time, length = _formats(maneuver)
    return (
        f"{maneuver.word}, {maneuver.turn.described}: joins in {time(maneuver.duration_s)} "
        f"after {length(maneuver.length_m)}"
    )


def table(maneuver: Maneuver) -> Table:
    """A row for each piece and one for the join."""
    time, length = _formats(maneuver)
    rows = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    rows.add_column("in", justify="right")
    rows.add_column("do", justify="left")
    for heading in ("for", "length", "from the centre", "heading, deg"):
        rows.add_column(heading, justify="right")
    for segment in maneuver.segments:
        rows.add_row(
            time(segment.start_s),
            ACTIONS[segment.letter],
            time(segment.duration_s),
            length(segment.length_m),
            length(maneuver.orbit.distance_m(segment.start)),
            _degrees(segment.start.heading_deg),
        )
    rows.add_row(
        time(maneuver.duration_s),
        f"hold {maneuver.turn.described}",
        "",
        "",
        length(maneuver.orbit.distance_m(maneuver.join)),
        _degrees(maneuver.join.heading_deg),
    )
    return rows


def peel_off(maneuver: Maneuver) -> str:
    """Where the last piece begins: "Peel off: turn left in 12.4 s, 138 m from the centre."."""
    time, length = _formats(maneuver)
    last = maneuver.segments[-1]
    when = f"in {time(last.start_s)}" if len(maneuver.segments) > 1 else "now"
    return f"Peel off: {ACTIONS[last.letter]} {when}, {length(maneuver.orbit.distance_m(last.start))} from the centre."


def other_direction(best: Sequence[Maneuver], others: Sequence[Maneuver]) -> str:
    """What holding the circle the other way round would cost."""
    first = best[0]
    other = next(m for m in (*best, *others) if m.turn != first.turn)
    later = other.duration_s - first.duration_s
    subject = other.turn.described.capitalize()
    if abs(later) <= SAME_TIME * other.duration_s:
        return f"{subject} takes the same time."
    return f"{subject} would join {_difference(abs(later))} {'later' if later > 0.0 else 'sooner'}."


def _difference(seconds: float) -> str:
    if seconds < 1e-3:
        return "less than a millisecond"
    return f"{seconds:.0f} s" if seconds >= 100.0 else f"{seconds:.3g} s"


def _formats(maneuver: Maneuver) -> tuple[Callable[[float], str], Callable[[float], str]]:
    """Formats of times and of lengths, with as many decimals as the size of the scene asks for."""
    decimals = 1 if maneuver.orbit.radius_m >= 10.0 else 3
    return lambda seconds: f"{seconds:.{decimals}f} s", lambda metres: f"{metres:.{decimals}f} m"


def _degrees(value: float) -> str:
    return f"{round(value, 1) % 360.0:05.1f}"
