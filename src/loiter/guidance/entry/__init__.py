"""The law that flies the fastest entry: `LoiterEntry`, its pure step, and the route that it follows."""
