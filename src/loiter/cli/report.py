"""What `loiter plan` prints: tables for people, JSON for programs."""

import json
import sys
from collections.abc import Callable, Sequence
from math import atan2, degrees, hypot

from rich.console import Console, RenderableType
from rich.table import Table
from rich.text import Text

from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit, Pose
from loiter.planning.vocabulary import ACTIONS

# Two durations that are equal in theory differ by rounding, near 1e-15 of themselves in near and 1e-14 in far scenes.
SAME_TIME = 1e-12

# A miss is told from this share of the radius on: a metre on a kilometre.
SHOWN = 1e-3

# What a mission with waypoints all along the path costs (docs/maps.md).
ALONG_PATH = "Waypoints all along the path: autopilots cut its turns, and joined 2 to 4 s later than without --path."

# No line is longer; rich would cut or wrap at the width of the window, and numbers must stay whole.
WIDEST = 1000


def print_json(document: dict[str, object]) -> None:
    """Print one JSON object."""
    json.dump(document, sys.stdout, indent=2, allow_nan=False)
    sys.stdout.write("\n")


def print_tables(
    best: Sequence[Maneuver],
    others: Sequence[Maneuver],
    *,
    everything: bool,
    frame: LocalFrame | None = None,
    remark: str = "",
) -> None:
    """Print the first of `best`, or with `everything` each, and what the other direction costs; `remark` before all.

    With a frame headings are true, and places are told in degrees.
    """
    lines: list[RenderableType] = [remark] if remark else []
    lines += [weather(best[0])] if _windy(best[0]) else []
    for maneuver in best if everything else best[:1]:
        lines.append(Text(headline(maneuver), style="bold"))
        if maneuver.segments:
            lines += [table(maneuver, frame), peel_off(maneuver, frame)]
        if _windy(maneuver):
            lines += hold_in_wind(maneuver, frame)
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
        f"after {length(maneuver.length_m)}{' through the air' if _windy(maneuver) else ''}"
    )


def table(maneuver: Maneuver, frame: LocalFrame | None = None) -> Table:
    """A row for each piece and one for the join."""
    time, length = _formats(maneuver)
    rows = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    rows.add_column("in", justify="right")
    rows.add_column("do", justify="left")
    columns = ["for", "length", "from the centre", "heading, deg"]
    for heading in columns + ["track, deg", "ground speed"] * _windy(maneuver):
        rows.add_column(heading, justify="right")
    for segment in maneuver.segments:
        rows.add_row(
            time(segment.start_s),
            ACTIONS[segment.letter],
            time(segment.duration_s),
            length(segment.length_m),
            length(maneuver.orbit.after(segment.start_s).distance_m(segment.start)),
            _degrees(segment.start.heading_deg - _convergence_deg(segment.start, frame)),
            *_over_ground(maneuver, segment.start, frame),
        )
    rows.add_row(
        time(maneuver.duration_s),
        f"hold {maneuver.turn.described}",
        "",
        "",
        length(maneuver.orbit_at_join.distance_m(maneuver.join)),
        _degrees(maneuver.join.heading_deg - _convergence_deg(maneuver.join, frame)),
        *_over_ground(maneuver, maneuver.join, frame),
    )
    return rows


def _over_ground(maneuver: Maneuver, pose: Pose, frame: LocalFrame | None) -> list[str]:
    """Cells for track and ground speed; none in still air about a circle that rests."""
    if not _windy(maneuver):
        return []
    track_deg, speed = maneuver.over_ground(pose)
    return [_degrees(track_deg - _convergence_deg(pose, frame)), f"{speed:.1f} m/s"]


def _convergence_deg(pose: Pose, frame: LocalFrame | None) -> float:
    """What a heading of the plane has too much to be true."""
    return 0.0 if frame is None else pose.heading_deg - frame.place(pose).heading_deg


def weather(maneuver: Maneuver) -> str:
    """One line: the wind, and how the circle moves."""
    wind, orbit = maneuver.wind, maneuver.orbit
    text = f"Wind {wind.speed_m_s:g} m/s from {_degrees(wind.from_deg)} deg" if wind.speed_m_s else "Still air"
    if not orbit.moves:
        return f"{text}."
    east, north = orbit.velocity_east_m_s, orbit.velocity_north_m_s
    return (
        f"{text}; the circle moves at {hypot(east, north):.3g} m/s towards {_degrees(degrees(atan2(east, north)))} deg."
    )


def hold_in_wind(maneuver: Maneuver, frame: LocalFrame | None = None) -> list[str]:
    """What the wind asks of the hold, and where a circle that moves is joined."""
    lines, hold = [], maneuver.hold
    if maneuver.orbit.moves and maneuver.segments:
        centre = _place(maneuver, maneuver.orbit_at_join, frame)
        lines.append(f"When it is joined the circle's centre is at {centre}.")
    least, most = f"{hold.least_bank_deg:.1f}", f"{hold.largest_bank_deg:.1f}"
    if least == most:
        lines.append(f"Bank on the circle: {most} deg.")
    else:
        azimuth = round(hold.largest_bank_azimuth_deg) % 360
        lines.append(f"Bank on the circle: {least} to {most} deg, most at azimuth {azimuth:03d} deg.")
    return lines


def _place(maneuver: Maneuver, place: Pose | Orbit, frame: LocalFrame | None) -> str:
    if frame is not None:
        return degrees_of(*frame.place(Pose(place.east_m, place.north_m, 0.0))[:2])
    _, length = _formats(maneuver)
    return f"{length(place.east_m)} east, {length(place.north_m)} north"


def _windy(maneuver: Maneuver) -> bool:
    """Whether the ground track differs from the path through the air, or the circle moves."""
    return maneuver.wind.speed_m_s > 0.0 or maneuver.orbit.moves


def peel_off(maneuver: Maneuver, frame: LocalFrame | None = None) -> str:
    """Where the last piece begins: "Peel off: turn left in 12.4 s, 138 m from the centre."."""
    time, length = _formats(maneuver)
    last = maneuver.segments[-1]
    when = f"in {time(last.start_s)}" if len(maneuver.segments) > 1 else "now"
    away = length(maneuver.orbit.after(last.start_s).distance_m(last.start))
    where = f", at {_place(maneuver, last.start, frame)}" if _windy(maneuver) or frame is not None else ""
    return f"Peel off: {ACTIONS[last.letter]} {when}, {away} from the centre{where}."


def other_direction(best: Sequence[Maneuver], others: Sequence[Maneuver]) -> str:
    """What holding the circle the other way round would cost."""
    first = best[0]
    other = next(m for m in (*best, *others) if m.turn != first.turn)
    later = other.duration_s - first.duration_s
    subject = other.turn.described.capitalize()
    if other in best or abs(later) <= SAME_TIME * other.duration_s:
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
