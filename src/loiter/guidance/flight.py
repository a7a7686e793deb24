"""Former import path of `loiter.guidance.trials.flight`, given in earlier documentation."""

from loiter.guidance.trials.flight import Flight, FlightTrack, fly

# The former name of `FlightTrack`.
Track = FlightTrack

__all__ = ["Flight", "FlightTrack", "Track", "fly"]
