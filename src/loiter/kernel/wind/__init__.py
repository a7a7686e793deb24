"""The parts of the search in wind, `kernel.wind_search`: first paths, bounds for arcs of the circle, local minima."""
