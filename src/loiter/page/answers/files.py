"""What the page does not write to a file."""

from loiter.errors import InvalidArgument
from loiter.files.maps.track import step_counts
from loiter.planning.maneuver import Maneuver

# The most points of a track that the page writes to a file, a second's work; `loiter plan --save` has no such limit.
MAX_POINTS = 20_000


def check_points(maneuver: Maneuver, chord_error_m: float) -> None:
    """Raise `InvalidArgument` where the track would have more than `MAX_POINTS` points."""
    count = sum(step_counts(maneuver, None, chord_error_m))
    if count > MAX_POINTS:
        raise InvalidArgument(
            "chord_error_m",
            f"is {chord_error_m:g}: the file would have {count:,} points; the page writes at most {MAX_POINTS:,}, "
            "loiter plan --save writes more",
        )
