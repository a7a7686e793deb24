"""The fields of a scene, for refusals."""

from typing import NamedTuple

from loiter.planning.model import TURN_LIMITS


class SceneField(NamedTuple):
    """The field of a scene for an argument of the library: its name in sentences, and its path in the scene."""

    name: str
    path: str


# Arguments of the library that have another name in a scene. An argument "pose east_m" is the field pose/east_m.
SCENE_FIELDS = {name: SceneField(f"aircraft.{name}", f"aircraft/{name}") for name in ("airspeed_m_s", *TURN_LIMITS)} | {
    "turn": SceneField("orbit.turn", "orbit/turn"),
    "turn limit": SceneField("the turn limit of the aircraft", "aircraft"),
    "turn radius": SceneField("the turn radius of the aircraft", "aircraft"),
    "frame": SceneField("origin", "origin"),
}
