"""The fastest entry in still air: every extremal in closed form, the fastest of them, and the paper's curves."""
