"""The picture of a certificate: which curves, which instants, which title."""

import numpy as np
import pytest

from loiter import Aircraft, Orbit, Pose, candidates, plan
from loiter.certificate import certify
from loiter.plot.certificate import draw
from loiter.plot.files import FORMATS, save_figure

UNIT = Aircraft(1.0, min_turn_radius_m=1.0)
SCENE = Pose(-0.53, 0.31, 90.0), Orbit(0.0, 0.0, 1.0), UNIT


def lines(figure, gid):
    return [line for axes in figure.axes for line in axes.lines if line.get_gid() == gid]


def test_curves_are_those_of_the_certificate():
    certificate = certify(plan(*SCENE))
    figure = draw(certificate)
    assert [line.get_ydata()[0] for line in lines(figure, "u")] == [1, -1, 1]
    (phi,), (psi1,), (psi2,), (lam,) = (lines(figure, gid) for gid in ("phi", "psi1", "psi2", "lambda"))
    assert lam.get_ydata()[0] == certificate.lam
    assert np.hypot(psi1.get_ydata(), psi2.get_ydata()) == pytest.approx(1.0, abs=1e-14)
    assert np.abs(phi.get_ydata()) + psi1.get_ydata() == pytest.approx(certificate.lam, abs=1e-13)
    assert (phi.get_xdata()[0], phi.get_xdata()[-1]) == (0.0, pytest.approx(certificate.maneuver.duration_s))


def test_switching_instants_are_marked_in_every_panel():
    certificate = certify(plan(*SCENE))
    marked = [line.get_xdata()[0] for line in lines(draw(certificate), "switch")]
    assert marked == [switch.time_s for switch in certificate.switches] * 3


def test_the_title_says_what_holds_or_what_does_not():
    assert draw(certify(plan(*SCENE))).axes[0].get_title() == "LRL, clockwise: every condition holds"
    loser = next(m for m in candidates(*SCENE) if m.word == "RL")
    title = draw(certify(loser)).axes[0].get_title()
    assert title == "RL, clockwise: violates sign, hamiltonian, psi1, gradient, fastest"


def test_a_start_on_the_circle_draws_empty_panels():
    figure = draw(certify(plan(Pose(0.0, 1.0, 90.0), *SCENE[1:])))
    assert lines(figure, "u") == []
    assert figure.axes[0].get_title() == "on the circle, clockwise: every condition holds"


@pytest.mark.parametrize("ending", FORMATS)
def test_each_format_is_written_whole(tmp_path, ending):
    path = tmp_path / f"proof{ending}"
    save_figure(path, draw(certify(plan(*SCENE))))
    assert path.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [path]
