"""Output of the commands: lines and tables for people, JSON for programs."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from math import atan2, degrees, hypot, isfinite

from rich.console import Console, RenderableType
from rich.table import Table
from rich.text import Text

from loiter.files.missions.altitudes import AltitudeDatum, AltitudeReference
from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.compass import wrapped
from loiter.planning.flight import radius_of
from loiter.planning.leg import LegPlan
from loiter.planning.maneuver import Maneuver, decimals_of
from loiter.planning.model import ACTIONS, Orbit, Pose, Segment

# Durations that are equal in theory differ by rounding, relatively by 1e-15 in near scenes and by 1e-14 in far ones.
SAME_DURATION = 1e-12

# A miss is printed if it is above this share of the radius: a metre for a radius of a kilometre.
SMALLEST_MISS = 1e-3

# What a mission with waypoints all along the path costs (docs/maps.md).
ALONG_PATH = "Waypoints all along the path: autopilots cut its turns, and joined 2 to 4 s later than without --path."

# Wider than any line: rich would cut or wrap lines at the width of the window, and numbers must stay whole.
CONSOLE_WIDTH = 1000


def print_json(document: dict[str, object]) -> None:
    """Print one JSON object."""
    json.dump(document, sys.stdout, indent=2, allow_nan=False)
    sys.stdout.write("\n")


def json_value(value: str | int | float | bool) -> str | int | float | bool | None:
    """A value for JSON, which has neither nan nor infinity: these are None."""
    return None if isinstance(value, float) and not isfinite(value) else value


def altitude_lines(altitude_m: float, datum: AltitudeDatum, *, home_known: bool) -> list[str]:
    """A line on the altitude that a mission has: on its reference, and on a home whose altitude is not known."""
    text = f"The mission is at {altitude_m:g} {datum.unit.replace('metres', 'm')}"
    if datum.reference != AltitudeReference.MSL:
        return [f"{text}; home is at {datum.home_altitude_m:g} m above mean sea level."]
    lines = [f"{text}, not above the ground."]
    if not home_known:
        lines.append(f"The altitude of home is not known, so it is {altitude_m:g} m too; --home-altitude sets it.")
    return lines


def plan_lines(
    best: Sequence[Maneuver], others: Sequence[Maneuver], *, everything: bool, frame: LocalFrame | None
) -> list[RenderableType]:
    """The first of `best`, with `everything` each of them, as tables, and the cost of the other direction.

    With a frame headings are true, and places are in degrees.
    """
    first, *ties = best
    lines: list[RenderableType] = [weather(first)] if _windy(first) else []
    for maneuver in best if everything else [first]:
        lines += _description(maneuver, frame)
    # A plan that is shown does not need a line on what it costs.
    if not everything or len({maneuver.turn for maneuver in best}) == 1:
        lines.append(other_direction(best, others))
    if ties and not everything:
        lines.append(f"{len(best)} maneuvers are optimal; --all shows each.")
    return lines


def _description(maneuver: Maneuver, frame: LocalFrame | None) -> list[RenderableType]:
    """Headline, table and remarks of a maneuver."""
    lines: list[RenderableType] = [headline(str(maneuver))]
    if maneuver.segments:
        lines += [table(maneuver, frame), peel_off(maneuver, frame)]
    if _windy(maneuver):
        lines += hold_in_wind(maneuver, frame)
    if maneuver.miss_m > SMALLEST_MISS * maneuver.orbit.radius_m:
        lines.append(f"Ends {maneuver.miss_m:.3g} m off the point of joining, within the tolerance.")
    return lines


def headline(text: str) -> Text:
    """The first line of a plan."""
    return Text(text, style="bold")


def write(*lines: RenderableType) -> None:
    """Write lines and tables to standard output, all at once and without cutting them to the width of the window."""
    console = Console(highlight=False, width=CONSOLE_WIDTH)
    with console.capture() as capture:
        for line in lines:
            console.print(line)
    sys.stdout.write(capture.get())


def write_now(line: str) -> None:
    """Print a line and flush standard output, which a pipe would buffer."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def new_table() -> Table:
    """An empty table without lines, its columns two spaces apart."""
    return Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))


def table(maneuver: Maneuver, frame: LocalFrame | None = None) -> Table:
    """A table with a row for each segment and one for the hold."""
    rows = _entry_table(maneuver, frame)
    _add_row(rows, maneuver, maneuver.duration_s, f"hold {maneuver.turn.described}", None, maneuver.join, frame)
    return rows


def leg_table(plan: LegPlan, frame: LocalFrame | None = None) -> Table:
    """A table with a row for each segment of the entry, for the hold, for the straight way out and for its end."""
    entry = plan.entry
    rows = _entry_table(entry, frame)
    hold = f"hold {plan.turn.described}, {plan.held_deg / 360.0:.2f} turns"
    _add_row(rows, entry, entry.duration_s, hold, (plan.held_s, None), entry.join, frame)
    straight = plan.straight_s, plan.straight_s * entry.aircraft.airspeed_m_s
    _add_row(rows, entry, plan.exit_s, "leave straight", straight, plan.exit, frame)
    _add_row(rows, entry, plan.duration_s, "at the point", None, plan.end, frame)
    return rows


def _entry_table(maneuver: Maneuver, frame: LocalFrame | None) -> Table:
    """A table with a row for each segment."""
    rows = new_table()
    rows.add_column("in", justify="right")
    rows.add_column("do", justify="left")
    columns = ["for", "length", "from the centre", "heading, deg"]
    for heading in columns + ["track, deg", "ground speed"] * _windy(maneuver):
        rows.add_column(heading, justify="right")
    for segment in maneuver.segments:
        flown = segment.duration_s, segment.length_m
        _add_row(rows, maneuver, segment.start_s, action(segment, maneuver), flown, segment.start, frame)
    return rows


def action(segment: Segment, maneuver: Maneuver) -> str:
    """What is flown: "turn left", and the radius of a turn that is wider than the tightest."""
    text, radius_m = ACTIONS[segment.letter], radius_of(segment, maneuver.aircraft)
    wide = segment.curvature_per_m != 0.0 and radius_m > maneuver.aircraft.turn_radius_m
    return f"{text}, radius {_metres(maneuver, radius_m)}" if wide else text


def _add_row(
    rows: Table,
    maneuver: Maneuver,
    time_s: float,
    action: str,
    flown: tuple[float, float | None] | None,
    pose: Pose,
    frame: LocalFrame | None,
) -> None:
    """Add a row for what begins at a time and a pose; `flown` are its seconds and metres, as far as they are known."""
    duration_s, length_m = flown or (None, None)
    rows.add_row(
        seconds(maneuver, time_s),
        action,
        "" if duration_s is None else seconds(maneuver, duration_s),
        "" if length_m is None else _metres(maneuver, length_m),
        _metres(maneuver, maneuver.orbit.after(time_s).distance_m(pose)),
        *_directions(maneuver, pose, frame),
    )


def _directions(maneuver: Maneuver, pose: Pose, frame: LocalFrame | None) -> list[str]:
    """Cells for the heading and, in wind or about a circle that moves, for track and ground speed."""
    convergence_deg = _convergence_deg(pose, frame)
    heading = _degrees(pose.heading_deg - convergence_deg)
    if not _windy(maneuver):
        return [heading]
    track_deg, speed_m_s = maneuver.over_ground(pose)
    return [heading, _degrees(track_deg - convergence_deg), f"{speed_m_s:.1f} m/s"]


def _convergence_deg(pose: Pose, frame: LocalFrame | None) -> float:
    """The heading in the local plane less the true heading, degrees; 0 without a frame."""
    return 0.0 if frame is None else pose.heading_deg - frame.place(pose).heading_deg


def begins(maneuver: Maneuver, lead_s: float, frame: LocalFrame | None) -> str:
    """One line: where a plan begins that does not begin now."""
    place = _place(maneuver, maneuver.start, frame)
    return f"Fly straight on for {lead_s:g} s; the plan, and its times, begin then, at {place}."


def weather(maneuver: Maneuver) -> str:
    """One line: the wind, and the velocity of a moving circle."""
    wind, orbit = maneuver.wind, maneuver.orbit
    text = f"Wind {wind.speed_m_s:.4g} m/s from {_degrees(wind.from_deg)} deg" if wind.speed_m_s else "Still air"
    if not orbit.moves:
        return f"{text}."
    east, north = orbit.velocity_east_m_s, orbit.velocity_north_m_s
    return (
        f"{text}; the circle moves at {hypot(east, north):.3g} m/s towards {_degrees(degrees(atan2(east, north)))} deg."
    )


def hold_in_wind(maneuver: Maneuver, frame: LocalFrame | None = None) -> list[str]:
    """Lines on the bank that the hold needs, and on the position of a moving circle at the join."""
    lines, hold = [], maneuver.hold
    if maneuver.orbit.moves and maneuver.segments:
        centre = _place(maneuver, maneuver.orbit_at_join, frame)
        lines.append(f"The centre of the circle is at {centre} when it is joined.")
    least, most = f"{hold.least_bank_deg:.1f}", f"{hold.largest_bank_deg:.1f}"
    if least == most:
        lines.append(f"Bank on the circle: {most} deg.")
    else:
        azimuth = round(wrapped(round(hold.largest_bank_azimuth_deg)))
        lines.append(f"Bank on the circle: {least} to {most} deg, most at azimuth {azimuth:03d} deg.")
    return lines


def _place(maneuver: Maneuver, place: Pose | Orbit, frame: LocalFrame | None) -> str:
    if frame is not None:
        geodetic = frame.place(Pose(place.east_m, place.north_m, 0.0))
        return degrees_of(geodetic.latitude_deg, geodetic.longitude_deg)
    return f"{_metres(maneuver, place.east_m)} east, {_metres(maneuver, place.north_m)} north"


def _windy(maneuver: Maneuver) -> bool:
    """Whether the ground track differs from the path through the air, or the circle moves."""
    return maneuver.wind.speed_m_s > 0.0 or maneuver.orbit.moves


def peel_off(maneuver: Maneuver, frame: LocalFrame | None = None) -> str:
    """Where the last segment begins: "Peel off: turn left in 12.4 s, 138 m from the centre, at 9 m east, ..."."""
    *before, last = maneuver.segments
    when = f"in {seconds(maneuver, last.start_s)}" if before else "now"
    distance = _metres(maneuver, maneuver.orbit.after(last.start_s).distance_m(last.start))
    where = _place(maneuver, last.start, frame)
    return f"Peel off: {action(last, maneuver)} {when}, {distance} from the centre, at {where}."


def other_direction(best: Sequence[Maneuver], others: Sequence[Maneuver]) -> str:
    """One line: how much later or sooner the best maneuver of the other direction joins."""
    first, *rest = *best, *others
    other = next((m for m in rest if m.turn != first.turn), None)
    if other is None:
        return f"{first.turn.other.described.capitalize()}, no path arrives there at that time."
    later = other.duration_s - first.duration_s
    subject = other.turn.described.capitalize()
    if other in best or abs(later) <= SAME_DURATION * other.duration_s:
        return f"{subject} takes the same time."
    return f"{subject} would join {_difference(abs(later))} {'later' if later > 0.0 else 'sooner'}."


def _difference(time_s: float) -> str:
    if time_s < 1e-3:
        return "less than a millisecond"
    return f"{time_s:.0f} s" if time_s >= 100.0 else f"{time_s:.3g} s"


def seconds(maneuver: Maneuver, time_s: float) -> str:
    """A time of the maneuver as text."""
    return f"{time_s:.{decimals_of(maneuver.orbit)}f} s"


def _metres(maneuver: Maneuver, metres: float) -> str:
    """A length of the maneuver as text."""
    return f"{metres:.{decimals_of(maneuver.orbit)}f} m"


def _degrees(value: float) -> str:
    return f"{wrapped(round(value, 1)):05.1f}"
