"""Theorem 2 of proof.md, from rotations to the maneuver that is returned."""
