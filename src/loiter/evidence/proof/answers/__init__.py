"""Theorem 2 of docs/proof.md, from rotations to the maneuver that is returned."""
