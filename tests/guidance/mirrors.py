"""The circle-following laws, states to test them in, and mirror images in the north axis."""

from hypothesis import strategies as st

from guidance.circling import state_of
from loiter import Aircraft, Orbit
from loiter.guidance.protocol import Command, Phase, State
from loiter.lab.rivals.l1 import L1
from loiter.lab.rivals.tangent import Tangent
from loiter.lab.rivals.vector_field import VectorField
from loiter.planning.compass import heading_vector

FOLLOWERS = {"L1": L1, "vector field": VectorField, "tangent": Tangent}

OTHER_PHASE = {Phase.LEFT: Phase.RIGHT, Phase.RIGHT: Phase.LEFT}


def states(uav: Aircraft) -> st.SearchStrategy[State]:
    """States in still air and in wind, up to a kilometre from the origin."""
    metres, knots = st.floats(-1000.0, 1000.0), st.floats(-8.0, 8.0)
    headings = st.floats(0.0, 360.0)
    return st.builds(
        lambda east, north, heading, wind: state_of(3.0, east, north, *heading_vector(heading), uav, wind),
        metres,
        metres,
        headings,
        st.tuples(knots, knots),
    )


def mirrored_state(state: State) -> State:
    return state._replace(
        east_m=-state.east_m,
        heading_deg=-state.heading_deg,
        bank_deg=-state.bank_deg,
        velocity_east_m_s=-state.velocity_east_m_s,
    )


def mirrored_orbit(orbit: Orbit) -> Orbit:
    return Orbit(-orbit.east_m, orbit.north_m, orbit.radius_m, orbit.turn.other)


def mirrored_command(command: Command) -> Command:
    return command._replace(
        turn_rate_deg_s=-command.turn_rate_deg_s,
        bank_deg=-command.bank_deg,
        phase=OTHER_PHASE.get(command.phase, command.phase),
        turn=command.turn.other,
        next_phase=OTHER_PHASE.get(command.next_phase, command.next_phase),
    )
