"""The closed-loop law that flies the fastest entry, laws to compare it with, and simulators to fly them in."""

from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Command, Law, Phase, Simulator, State

__all__ = ["Command", "Law", "LoiterEntry", "Phase", "Simulator", "State"]
