"""The log of a flight while it is flown: a CSV file, which has every step also if the program is killed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import nan
from pathlib import Path

from loiter.errors import InvalidArgument
from loiter.files.flight_log import LogRow, LogWriter
from loiter.flight.guiding.report import GuideReport
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import VehicleEstimates
from loiter.planning.model import Orbit
from loiter.writing import check_writable

Record = Callable[[GuideReport], None]

# What is written before a state is measured.
NO_STATE = State(*[nan] * len(State._fields))


def check_log(path: Path | None) -> None:
    """Raise `InvalidArgument` for a log that could not be written."""
    if path is None:
        return
    if path.suffix.lower() != ".csv":
        raise InvalidArgument("log", f"is {str(path)!r}: the file name must end in .csv")
    check_writable("log", path)


@contextmanager
def step_log(path: Path | None, orbit: Callable[[], Orbit]) -> Iterator[Record]:
    """A context with a function that appends a report to the log; `orbit` gives the circle at that time."""
    if path is None:
        yield lambda report: None
        return
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = LogWriter(file)
        yield lambda report: writer.write(log_row(report, orbit()))


def log_row(report: GuideReport, orbit: Orbit) -> LogRow:
    """The row of a report."""
    s = report.state or NO_STATE
    return LogRow(
        time_s=report.time_s,
        clock_s=s.time_s,
        stage=report.stage.value,
        phase=report.phase.value,
        east_m=s.east_m,
        north_m=s.north_m,
        altitude_m=report.altitude_m,
        heading_deg=s.heading_deg,
        bank_deg=s.bank_deg,
        velocity_east_m_s=s.velocity_east_m_s,
        velocity_north_m_s=s.velocity_north_m_s,
        airspeed_m_s=s.airspeed_m_s,
        command_deg=report.command_deg,
        time_to_join_s=report.time_to_join_s,
        crosstrack_m=report.crosstrack_m,
        outside_m=report.outside_m,
        rate_hz=report.rate_hz,
        age_s=report.age_s,
        **_estimates(report.estimates),
        orbit_east_m=orbit.east_m,
        orbit_north_m=orbit.north_m,
        orbit_radius_m=orbit.radius_m,
        turn=report.turn.value,
    )


def _estimates(e: VehicleEstimates | None) -> dict[str, float]:
    """The columns of the law's estimates."""
    names = ["delay_s", "turn_ratio", "course_lead_s", "wind_east_m_s", "wind_north_m_s"]
    if e is None:
        return dict.fromkeys(["roll_time_s", "roll_rate_deg_s", *names], nan)
    roll = {"roll_time_s": float(e.roll.time_s), "roll_rate_deg_s": float(e.roll.rate_deg_s)}
    return roll | {name: float(getattr(e, name)) for name in names}
