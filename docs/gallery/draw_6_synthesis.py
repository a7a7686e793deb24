"""
The optimal synthesis
=====================

The reduced plane for a circle of the turn radius, held in either direction (Fig. 4 of the paper), and for one of 1.5
turn radii, held clockwise: where each word wins.
"""

from loiter.arrays.partition import boundaries, partition
from loiter.plot.synthesis import draw

regions = partition(radius=1.0, turn="either", cells=300)
figure = draw(regions, boundaries(regions))

# %%
regions = partition(radius=1.5, turn="cw", cells=300)
wider = draw(regions, boundaries(regions))
