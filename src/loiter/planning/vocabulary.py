"""The words for what a pilot does, by the letter of a segment: each stands here once."""

# As an instruction.
ACTIONS = {"L": "turn left", "S": "fly straight", "R": "turn right"}

# The same in one word, for lines where space is short.
BRIEF_ACTIONS = {"L": "left", "S": "straight", "R": "right"}
