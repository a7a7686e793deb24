"""The bounds of a certificate belong together: an extremal chosen by rounding loses as much in each condition."""

import pytest

from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.certificate import certify

UAV = Aircraft(18.0, max_bank_deg=35.0)
SCENES = {
    "straight": (Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0)),
    "two arcs": (Pose(90.0, 60.0, 100.0), Orbit(0.0, 0.0, 80.0)),
    "three arcs": (Pose(-25.0, 15.0, 90.0), Orbit(0.0, 0.0, UAV.turn_radius_m)),
}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("wind", [None, Wind(3.0, 250.0)])
def test_the_hamiltonian_may_be_off_by_phi_and_by_psi(scene, wind):
    """|phi| + psi1 = lambda: the switching function and psi1 may each lose what the sign of phi may lose."""
    start, orbit = SCENES[scene]
    orbit = orbit if wind is None else Orbit(0.0, 0.0, 2.0 * orbit.radius_m)
    certificate = certify(plan(start, orbit, UAV, wind))
    multiplier, sign, hamiltonian = (certificate.residual(name).bound for name in ("multiplier", "sign", "hamiltonian"))
    lost = sign - multiplier if wind is None else sign
    assert lost > 0.0
    assert hamiltonian - (multiplier if wind is None else 0.0) == pytest.approx(2.0 * lost, rel=1e-12)
