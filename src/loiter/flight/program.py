"""The commands of this room, as the program lists them."""

from loiter.cli.command import FLIGHTS, Command

UNREACHED = """  3  the vehicle cannot be reached, does not answer or refuses: the sentence
     says what it has now"""

COMMANDS = (
    Command(
        "upload",
        "loiter.flight.transfer_commands:upload",
        FLIGHTS,
        80,
        help="""Send the fastest entry to a vehicle as a mission, then read the mission back and compare it item by item.""",
        examples=r"""
  loiter upload --connect udpin:127.0.0.1:14550 --pose-lla 47.1 8.2 90 \
      --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35 --altitude 900
  loiter upload entry.plan --connect /dev/ttyUSB0,57600""",
        statuses=(UNREACHED,),
        usage="Usage: loiter upload --connect LINK [OPTIONS] [FILE]",
    ),
    Command(
        "watch",
        "loiter.flight.transfer_commands:watch",
        FLIGHTS,
        90,
        help="""Listen to a vehicle and print, live, the fastest entry from its position.""",
        examples=r"""
  loiter watch --connect udpin:127.0.0.1:14550 \
      --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35
  loiter watch --connect udpin:127.0.0.1:14550 --reports 10 \
      --orbit-lla 47.11 8.23 --params uav.param""",
        statuses=(UNREACHED,),
    ),
    Command(
        "guide",
        "loiter.flight.guide_command:guide",
        FLIGHTS,
        100,
        help="""Guide a vehicle in flight onto the circle in least time, then hand it over to its own hold of the circle.

First the vehicle is commanded to hold the circle by its own guidance, the fall-back circle. Then its bank is commanded many times a second: ArduPlane's in GUIDED, PX4's in OFFBOARD; the autopilot holds altitude and airspeed. Once the circle is held steadily, the vehicle confirms that it holds it by its own guidance, and nothing more is sent. The vehicle must be in flight, and it and the circle at least 30 m above home: it is never armed, and never takes off or lands.

Before the first command a summary shows what is taken over and what happens if the link dies, and a question is asked; --yes answers it. Guiding stops at once, and one sentence says why, if the link or the telemetry is lost, the pilot or a failsafe changes the mode, another station commands, the altitude departs, or at Ctrl-C; the vehicle then flies the fall-back circle, or what the pilot wants. Airspeed and bank limit are those of the autopilot's parameters unless options give them. docs/autopilots.md has the details.""",
        examples=r"""
  loiter guide --connect udpin:127.0.0.1:14550 --orbit-lla 47.11 8.23 120
  loiter guide --connect tcp:127.0.0.1:5762 --dry-run \
      --orbit-lla 47.11 8.23 120 --turn ccw --bank 40
  loiter guide --connect udpin:127.0.0.1:14550 --orbit-lla 47.11 8.23 120 \
      --turn cw --airspeed 22 --slot 90 --slot-at 1790000000
  loiter guide --connect /dev/ttyUSB0,57600 --orbit-lla 47.11 8.23 120 \
      --altitude 900 --keep --log flight.csv""",
        statuses=(
            """  3  the vehicle cannot be reached, does not answer or refuses, or guiding
     had to stop: the sentence says what the vehicle has or does now""",
            "  130  interrupted; a guided vehicle flies its fall-back circle",
        ),
    ),
)
