"""Statuses: integer codes that the kernel returns instead of raising exceptions, with their messages."""

from enum import IntEnum


class Status(IntEnum):
    """The outcome for one state of an array call; the results are nan unless it is `OK`."""

    OK = 0
    NOT_FINITE = 1
    RADIUS_TOO_SMALL = 2
    OUT_OF_RANGE = 3
    BAD_TOLERANCE = 4
    BAD_AIRCRAFT = 5
    BAD_ORBIT = 6
    BAD_TURN = 7
    BAD_POSE = 8
    MALFORMED = 9
    WIND_TOO_STRONG = 10
    NOT_HELD = 11
    NOT_CONVERGED = 12
    BAD_WIND = 13
    BAD_SLOT = 14

    @property
    def message(self) -> str:
        """One sentence for a human reader."""
        return _MESSAGES[self]


_MESSAGES = {
    Status.OK: "solved",
    Status.NOT_FINITE: "the state, the radius or the wind is nan or infinite",
    Status.RADIUS_TOO_SMALL: "the circle is tighter than the minimum turn radius",
    Status.OUT_OF_RANGE: (
        "the state or the radius is beyond 2**52 turn radii, where a double cannot resolve one turn, or a place on "
        "Earth is more than 100 km away"
    ),
    Status.BAD_TOLERANCE: "the tolerance must be zero or positive, and below 2**52 turn radii",
    Status.BAD_AIRCRAFT: "airspeed and turn limit must be positive, finite numbers, and a bank below 90 degrees",
    Status.BAD_ORBIT: "the circle needs a finite centre and velocity, and a positive, finite radius",
    Status.BAD_TURN: "the turn must be cw, ccw or either",
    Status.BAD_POSE: "the position and the heading must be finite numbers, and latitudes within 90 degrees",
    Status.MALFORMED: "the line has more or fewer fields than the header, an open quote, is too long, or is not UTF-8",
    Status.WIND_TOO_STRONG: "the wind relative to the circle is as fast as the aircraft: |w| must be below 1",
    Status.NOT_HELD: "the circle is too tight to be held in this wind",
    Status.NOT_CONVERGED: "no maneuver was found that ends on the circle when flown",
    Status.BAD_WIND: "the wind needs a finite speed, zero or positive, and a finite direction",
    Status.BAD_SLOT: "the slot needs a finite bearing, and a finite time within 100,000 turns of the start",
}
