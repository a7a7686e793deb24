"""Identification of the vehicle in flight, from the commands that a law gives and the measurements it gets."""
