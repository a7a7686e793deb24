"""A module of MAVProxy: `module load loiter.flight.mavproxy` gives its console the commands of `loiter`.

MAVProxy keeps the link to the vehicle; the module adds an output to it, on a port of this machine, and the functions of
`loiter.flight` talk to the vehicle over that. Each runs in a thread, one at a time, so that MAVProxy goes on.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import replace
from socket import AF_INET, SOCK_DGRAM, socket
from threading import Event, Thread
from typing import Any, NamedTuple

import numpy as np
from MAVProxy.modules.lib import mp_module, mp_settings, mp_util
from pymavlink import mavutil

from loiter.errors import InvalidArgument, LoiterError
from loiter.files.missions.items import Mission
from loiter.files.missions.mission import mission
from loiter.files.missions.parameters import PARAMETERS
from loiter.flight import Report, guide, upload, watch
from loiter.flight.lines import guide_line, watch_line
from loiter.geo import LocalFrame, true_airspeed
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit

NAME = "loiter.flight.mavproxy"
USAGE = """loiter plan   [LAT LON [RADIUS]]  the fastest entry from where the vehicle is, on the console and on the map
loiter watch  [LAT LON [RADIUS]]  the same, live, a line a second
loiter upload [LAT LON [RADIUS]]  the entry as a mission, sent, read back and compared
loiter guide  [LAT LON [RADIUS]]  fly it by bank commands: a summary, and then "loiter yes" begins
loiter yes | stop                 begin to guide; end what runs (a guided vehicle then flies the circle by itself)
loiter set [NAME VALUE]           radius, turn (cw, ccw, either), airspeed (true), bank, altitude (above the sea)
Without LAT LON the centre is the last click on the map. What is not set is the vehicle's own: its parameters for the
airspeed, the bank limit and the radius, and its present altitude. Metres, degrees and metres per second."""

# Guided flights report so often that "stop" is obeyed soon, and every fourth report is printed.
GUIDE_PERIOD_S, PRINTED = 0.25, 4

# The layer, colour and width of what is drawn on the map, and the distance of its points, seconds and degrees.
LAYER, COLOUR, WIDTH, STEP_S, STEP_DEG = "loiter", (255, 128, 0), 2, 0.25, 5.0

# The names of the console for arguments of the library.
WORDS = {
    "origin latitude_deg": "LAT",
    "origin longitude_deg": "LON",
    "orbit radius_m": "RADIUS",
    "airspeed_m_s": "airspeed",
    "max_bank_deg": "bank",
    "altitude_m": "altitude",
    "accept_fly_away": "another COM_OBL_RC_ACT",
}


class Circle(NamedTuple):
    """A circle and the frame of its metres, whose origin is its centre."""

    orbit: Orbit
    frame: LocalFrame


class LoiterModule(mp_module.MPModule):  # type: ignore[misc]
    """The commands; `say` prints a line on the console."""

    def __init__(self, mpstate: Any) -> None:
        super().__init__(mpstate, NAME, "the fastest way onto a holding circle")
        numbers = [(name, float, 0.0) for name in ("radius", "airspeed", "bank", "altitude")]
        self.options = mp_settings.MPSettings([("turn", str, "either"), *numbers])
        self._output: Any = None
        self._thread: Thread | None = None
        self._stop, self._agreed = Event(), Event()
        self.add_command("loiter", self.command, "the fastest way onto a holding circle", list(COMMANDS))

    def command(self, words: list[str]) -> None:
        """Run a command of the console."""
        name, *arguments = words or ["help"]
        action = COMMANDS.get(name)
        if action is None:
            self.say(USAGE)
            return
        try:
            action(self, arguments)
        except (LoiterError, ValueError) as error:
            self.say(_sentence(error))

    def say(self, text: str) -> None:
        """Print on the console."""
        sys.stdout.write(text + "\n")
        sys.stdout.flush()

    def unload(self) -> None:
        """End what runs, and take the output away."""
        self.stop([])
        if self._thread is not None:
            self._thread.join(timeout=4.0)
        if self._output is not None:
            self.mpstate.mav_outputs.remove(self._output)
            self._output.close()

    def set(self, arguments: list[str]) -> None:
        """Show or change the settings."""
        self.options.command(arguments)

    def yes(self, arguments: list[str]) -> None:
        """Agree to the summary of a guided flight."""
        self._agreed.set()

    def stop(self, arguments: list[str]) -> None:
        """End what runs."""
        self._stop.set()

    def plan(self, arguments: list[str]) -> None:
        """Plan once, print and draw."""
        self._begin(self._planned, self._circle(arguments), lambda report, circle: None)

    def upload(self, arguments: list[str]) -> None:
        """Plan once, and send the plan as a mission."""
        self._begin(self._planned, self._circle(arguments), self._send)

    def watch(self, arguments: list[str]) -> None:
        """Plan again and again."""
        self._begin(self._watched, self._circle(arguments))

    def guide(self, arguments: list[str]) -> None:
        """Guide the vehicle, once the user has agreed."""
        self._begin(self._guided, self._circle(arguments))

    def _begin(self, job: Callable[..., None], *arguments: Any) -> None:
        """Run a job in the thread."""
        if self._thread is not None and self._thread.is_alive():
            raise InvalidArgument("another command", 'runs: "loiter stop" ends it')
        self._stop.clear()
        self._agreed.clear()
        connection = self._connection()

        def run() -> None:
            try:
                job(connection, *arguments)
            except LoiterError as error:
                self.say(_sentence(error))

        self._thread = Thread(target=run, name=NAME, daemon=True)
        self._thread.start()

    def _connection(self) -> str:
        """The other end of the output of MAVProxy, which is made at the first call."""
        if self._output is None:
            with socket(AF_INET, SOCK_DGRAM) as free:
                free.bind(("127.0.0.1", 0))
                _, port = free.getsockname()
            self._output = mavutil.mavlink_connection(
                f"127.0.0.1:{port}", input=False, source_system=self.settings.source_system
            )
            self._output.loiter_port = port
            self.mpstate.mav_outputs.append(self._output)
            mp_util.child_fd_list_add(self._output.port.fileno())
        return f"udpin:127.0.0.1:{self._output.loiter_port}"

    def _circle(self, arguments: list[str]) -> Circle:
        """The circle of a command's arguments, of the map's last click, and of the settings."""
        if len(arguments) > 3:
            raise InvalidArgument(" ".join(arguments[3:]), "is too much: a circle is LAT LON RADIUS")
        given = [_number(name, word) for name, word in zip(("LAT", "LON", "RADIUS"), arguments, strict=False)]
        place = given[:2] or list(self.mpstate.click_location or [])
        if len(place) != 2:
            raise InvalidArgument("centre", "is needed: LAT LON, or a click on the map")
        frame = LocalFrame(*place)
        radius_m = given[2] if len(given) > 2 else self.options.radius or self._parameter("loiter")
        if not radius_m:
            raise InvalidArgument("radius", "is needed: the vehicle's parameters are not known")
        return Circle(Orbit(0.0, 0.0, abs(radius_m), self.options.turn), frame)

    def _aircraft(self) -> Aircraft:
        """The aircraft of the settings, and of the vehicle's parameters."""
        airspeed = self.options.airspeed
        if not airspeed:
            indicated = self._parameter("indicated_airspeed_m_s")
            airspeed = indicated and true_airspeed(indicated, self._altitude_m())
        bank = self.options.bank or self._parameter("max_bank_deg")
        if not (airspeed and bank):
            raise InvalidArgument(
                "airspeed and bank", "are needed (loiter set): the vehicle's parameters are not known"
            )
        return Aircraft(airspeed, max_bank_deg=bank)

    def _parameter(self, quantity: str) -> float:
        """A quantity by the parameters that MAVProxy has read from the vehicle; 0 if it has none."""
        values = [
            float(self.mav_param[name]) / meaning.units
            for name, meaning in PARAMETERS.items()
            if meaning.quantity == quantity and name in self.mav_param
        ]
        return values[0] if values else 0.0

    def _altitude_m(self) -> float:
        """The altitude of the settings, otherwise the vehicle's, above mean sea level; 0 before its first position."""
        position = self.master.messages.get("GLOBAL_POSITION_INT")
        return float(self.options.altitude or (position.alt / 1e3 if position else 0.0))

    def _reports(self, connection: str, circle: Circle) -> Generator[Report, None, None]:
        system = self.target_system or None
        with closing(watch(connection, circle.orbit, circle.frame, self._aircraft(), system=system)) as reports:
            for report in reports:
                yield replace(report, problem=_in_words(report.problem))

    def _planned(self, connection: str, circle: Circle, then: Callable[[Report, Circle], None]) -> None:
        """Wait for a plan, print and draw it, and go on with it."""
        problem = ""
        with closing(self._reports(connection, circle)) as reports:
            for report in reports:
                if self._stop.is_set():
                    return
                if report.plan is not None:
                    break
                if report.problem != problem:
                    problem = report.problem
                    self.say(f"loiter: {problem}")
        assert report.plan is not None
        self.say(str(report.plan))
        self.say(watch_line(report).strip())
        self._draw(report.plan, circle.frame)
        then(report, circle)

    def _send(self, report: Report, circle: Circle) -> None:
        """Send a plan as a mission at the altitude of the settings or the vehicle."""
        best, altitude_m = report.plan, self._altitude_m()
        assert best is not None

        def to_mission(autopilot: int) -> Mission:
            return mission(best, circle.frame, altitude_m, autopilot=autopilot)

        summary = upload(to_mission, self._connection(), system=self.target_system or None)
        self.say(f"The vehicle has the mission: {summary.items} items sent and read back.")
        for sentence in (*summary.cut, *summary.remarks):
            self.say(sentence)

    def _watched(self, connection: str, circle: Circle) -> None:
        with closing(self._reports(connection, circle)) as reports:
            for report in reports:
                if self._stop.is_set():
                    return
                self.say(watch_line(report))
                if report.plan is not None:
                    self._draw(report.plan, circle.frame)

    def _guided(self, connection: str, circle: Circle) -> None:
        reports = guide(
            connection,
            circle.orbit,
            circle.frame,
            airspeed_m_s=self.options.airspeed or None,
            max_bank_deg=self.options.bank or None,
            system=self.target_system or None,
            altitude_m=self.options.altitude or None,
            period_s=GUIDE_PERIOD_S,
            confirm=self._agreed.is_set,
        )
        asked = False
        with closing(reports):
            for number, report in enumerate(reports):
                if self._stop.is_set():
                    break
                for notice in report.notices:
                    self.say(notice)
                if not asked:
                    self.say('"loiter yes" begins, "loiter stop" does not.')
                    asked = True
                elif number % PRINTED == 0 and self._agreed.is_set():
                    self.say(guide_line(report))
        self.say("loiter: stopped." if self._stop.is_set() else "loiter: the vehicle holds the circle by itself.")

    def _draw(self, maneuver: Maneuver, frame: LocalFrame) -> None:
        """Draw the path and the circle on every map of MAVProxy."""
        maps = self.module_matching("map*")
        if not maps:
            return
        # It needs OpenCV, as maps do.
        from MAVProxy.modules.mavproxy_map.mp_slipmap_util import SlipPolygon

        track, circle = maneuver.sample(STEP_S), maneuver.orbit_at_join
        out = np.degrees(np.arctan2(maneuver.join.east_m - circle.east_m, maneuver.join.north_m - circle.north_m))
        around = np.radians(out + np.arange(0.0, 360.0 + STEP_DEG, STEP_DEG))
        places = frame.to_geodetic(
            np.concatenate([track.east_m, circle.east_m + circle.radius_m * np.sin(around)]),
            np.concatenate([track.north_m, circle.north_m + circle.radius_m * np.cos(around)]),
        )
        line = SlipPolygon(NAME, np.transpose(places).tolist(), LAYER, COLOUR, WIDTH, showcircles=False)
        for each in maps:
            each.map.add_object(line)


def _number(name: str, word: str) -> float:
    """A number of the console; raises `InvalidArgument` for another word."""
    try:
        return float(word)
    except ValueError:
        raise InvalidArgument(name, f"is {word!r}: it must be a number") from None


def _sentence(error: Exception) -> str:
    """The message of an error, in the words of the console."""
    if isinstance(error, InvalidArgument):
        return f"loiter: {WORDS.get(error.argument, error.argument)} {error.problem}"
    return f"loiter: {_in_words(str(error))}"


def _in_words(problem: str) -> str:
    """A problem in the words of the console, where the origin of the plane is the centre of the circle."""
    return problem.replace("the origin", "the centre")


COMMANDS: dict[str, Callable[[LoiterModule, list[str]], None]] = {
    "plan": LoiterModule.plan,
    "watch": LoiterModule.watch,
    "upload": LoiterModule.upload,
    "guide": LoiterModule.guide,
    "yes": LoiterModule.yes,
    "stop": LoiterModule.stop,
    "set": LoiterModule.set,
}


def init(mpstate: Any) -> LoiterModule:
    """The module, for MAVProxy."""
    return LoiterModule(mpstate)
