"""
The least time
==============

The time to join a circle of the turn radius clockwise, in turn radii over airspeed. It jumps at the bold line: an
aircraft just inside the last arc has to fly a turn more.
"""

from loiter.arrays.partition import boundaries, partition
from loiter.plot.synthesis import draw

regions = partition(radius=1.0, turn="cw", cells=300)
figure = draw(regions, boundaries(regions), show="time")
