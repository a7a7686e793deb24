"""
A figure of the paper
=====================

The second of the two examples of the paper: the optimal trajectory. ``loiter figures`` draws all seven figures.
"""

from loiter.plot.figures import figure_7

figure = figure_7()
