"""
How long from where
===================

The time to join for an aircraft that heads east, as a function of where it is: an array of 90,000 starts.
"""

import numpy as np
from matplotlib.figure import Figure

import loiter

uav, orbit = loiter.Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0), loiter.Orbit(0.0, 0.0, radius_m=80.0)
metres = np.linspace(-400.0, 400.0, 300)
x, y = loiter.reduce(metres, metres[:, np.newaxis], 90.0, orbit, uav)
radius = orbit.radius_m / uav.turn_radius_m
seconds = loiter.min_time(x, y, radius) * uav.turn_radius_m / uav.airspeed_m_s

figure = Figure(figsize=(7.2, 6.0), layout="constrained")
axes = figure.add_subplot(aspect="equal", xlabel="east (m)", ylabel="north (m)", title="Time to join, heading east (s)")
figure.colorbar(axes.contourf(metres, metres, seconds, levels=24, cmap="viridis"))
around = np.linspace(0.0, 2.0 * np.pi, 200)
axes.plot(80.0 * np.cos(around), 80.0 * np.sin(around), "w--")
