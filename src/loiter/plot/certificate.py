"""The certificate of a maneuver over time: its control, the switching function and the adjoint."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from loiter.certificate.entry_certificate import Certificate, Instant
from loiter.plot.picture import COLOURS

# Chords of a sine over a hundredth of a turn differ from it by 0.05 % of its height, less than the width of a line.
STEPS = 100

LINES = {"phi": "#000000", "psi1": "#0072B2", "psi2": "#D55E00"}
LABELS = {"phi": "φ", "psi1": "ψ1", "psi2": "ψ2"}
CONTROL_COLOURS = {1: COLOURS["L"], 0: COLOURS["S"], -1: COLOURS["R"]}


def draw(certificate: Certificate) -> Figure:
    """Draw u, phi, psi1 and psi2 over time (seconds), with lambda and the switching instants marked.

    Where phi > 0 the control is +1, where phi < 0 it is -1; psi1 stays below lambda and equals it where phi = 0. The
    panels are empty for a start on the circle, which has no pieces.
    """
    figure = Figure(figsize=(8.0, 6.4), layout="constrained")
    control, switching, adjoint = figure.subplots(3, sharex=True, height_ratios=(1.0, 2.0, 2.0))
    pieces = list(certificate.history(STEPS))
    _draw_control(control, pieces)
    _draw_values(switching, pieces, "phi")
    switching.axhline(0.0, color="#808080", linewidth=0.8, gid="zero")
    for name in ("psi1", "psi2"):
        _draw_values(adjoint, pieces, name)
    if certificate.lam is not None:
        adjoint.axhline(certificate.lam, color="#808080", linestyle="--", label="λ", gid="lambda")
        adjoint.legend(loc="best", ncols=3, fontsize="small")
    for axes in (control, switching, adjoint):
        for switch in certificate.switches:
            axes.axvline(switch.time_s, color="#808080", linewidth=0.8, linestyle=":", gid="switch")
    switching.set_ylabel("φ (turn radii)")
    adjoint.set_ylabel("ψ")
    adjoint.set_xlabel("time (s)")
    control.set_title(_title(certificate))
    return figure


def _draw_control(axes: Axes, pieces: list[list[Instant]]) -> None:
    for piece in pieces:
        times = [instant.time_s for instant in piece]
        u, *_ = (instant.u for instant in piece)
        axes.plot(times, [u] * len(times), color=CONTROL_COLOURS[u], linewidth=2.6, gid="u")
    axes.set_ylim(-1.4, 1.4)
    axes.set_yticks([-1, 0, 1], ["right", "straight", "left"])
    axes.set_ylabel("u")


def _draw_values(axes: Axes, pieces: list[list[Instant]], name: str) -> None:
    times = [instant.time_s for piece in pieces for instant in piece]
    values = [getattr(instant, name) for piece in pieces for instant in piece]
    axes.plot(times, values, color=LINES[name], linewidth=1.6, label=LABELS[name], gid=name)


def _title(certificate: Certificate) -> str:
    maneuver = certificate.maneuver
    what = f"{maneuver.word or 'on the circle'}, {maneuver.turn.described}"
    if certificate.valid:
        return f"{what}: every condition holds"
    return f"{what}: violates {', '.join(residual.name for residual in certificate.failed)}"
