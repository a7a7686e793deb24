"""mavsdk plays a vehicle: `python server.py PORT` prints every mission that arrives there, a line of JSON each.

It says ten times a second that it is at 47.002 N, 8 E, 600 m above the sea, and flies for 123 degrees at 18 m/s.
"""

import json
import sys
import time
from contextlib import suppress
from math import cos, radians, sin

from mavsdk.mavsdk import Configuration, Mavsdk
from mavsdk.plugins.mission_raw_server import MissionRawServer
from mavsdk.plugins.telemetry_server import Heading, Position, TelemetryServer, TelemetryServerError, VelocityNed

HEADING_DEG, SPEED_M_S = 123.0, 18.0
VELOCITY = VelocityNed(SPEED_M_S * cos(radians(HEADING_DEG)), SPEED_M_S * sin(radians(HEADING_DEG)), 0.0)
FIELDS = ["command", "frame", "param1", "param2", "param3", "param4", "x", "y", "z", "autocontinue"]


def arrived(result, plan, _):
    items = [[getattr(item, name) for name in FIELDS] for item in plan.mission_items]
    print(json.dumps([result.name, items]), flush=True)


def serve(port):
    mavsdk = Mavsdk(Configuration.create_manual(1, 1, True))
    mavsdk.add_any_connection(f"udpin://127.0.0.1:{port}")
    server = MissionRawServer(mavsdk.server_component())
    server.subscribe_incoming_mission(arrived)
    telemetry = TelemetryServer(mavsdk.server_component())
    print(json.dumps(["READY", mavsdk.version()]), flush=True)
    while True:
        time.sleep(0.1)
        # There may be nobody yet to tell.
        with suppress(TelemetryServerError):
            telemetry.publish_position(Position(47.002, 8.0, 600.0, 100.0), VELOCITY, Heading(HEADING_DEG))


if __name__ == "__main__":
    serve(int(sys.argv[1]))
