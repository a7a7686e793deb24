"""The fastest entry in wind, and onto circles that move: a search over the point of joining, and its parts."""
