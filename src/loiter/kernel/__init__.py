"""The mathematics, in the normalised reduced plane: turn radius 1, speed 1, numbers in, numbers out.

Symbols are those of the paper (docs/theory.md): `x`, `y` are the reduced state (2), `u` the control (+1 turns left),
`R` the radius of the circle in turn radii. Angles are mathematical: radians, counter-clockwise from the x axis.
"""
