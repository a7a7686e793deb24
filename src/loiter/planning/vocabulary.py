"""Texts that several front ends share: actions of the pilot, and curves of the synthesis."""

# What the pilot does on a segment, by its letter.
ACTIONS = {"L": "turn left", "S": "fly straight", "R": "turn right"}

# The same in one word, for lines where space is short.
BRIEF_ACTIONS = {"L": "left", "S": "straight", "R": "right"}

# The kinds of curves between the regions of a synthesis.
BOUNDARIES = {
    "jump": "T jumps",
    "same": "same first control",
    "straight": "straight flight",
    "switch": "switching curve",
    "tie": "two controls tie",
}
