"""The commands of this room, as the program lists them."""

from loiter.cli.command import FLIGHTS, PLANS, Command

COMMANDS = (
    Command(
        "fleet",
        "loiter.fleets.command:fleet",
        PLANS,
        30,
        help="""Plan the entries of several aircraft onto one circle, each into a slot: a place that moves round the circle with the hold.

FILE is a CSV file with a row for each aircraft: its position and heading, in the columns of loiter batch, and a name if it has a column name. They are of one kind, and share the circle, the airspeed, the turn limit and the wind. Their slots pass a place at equal intervals; which aircraft takes which slot brings the last one in soonest.""",
        examples=r"""
  loiter fleet fleet.csv --orbit 0 0 120 --airspeed 18 --bank 35 \
      --separation 100 --plot fleet.png
  loiter fleet fleet.csv --orbit-lla 47.11 8.23 120 --airspeed 18 \
      --bank 35 --wind 8 250 --altitude 900 --save fleet.kml""",
    ),
    Command(
        "guide-fleet",
        "loiter.fleets.guide_command:guide_fleet",
        FLIGHTS,
        110,
        help="""Guide several vehicles in flight onto one circle, each into a slot of its own.

FILE has a row for each vehicle. What is commanded, and what ends it, is as with loiter guide; nothing is handed over: the vehicles keep their slots until Ctrl-C, and then fly the fall-back circle.""",
        examples=r"""
  loiter guide-fleet vehicles.csv --orbit-lla 47.11 8.23 120 \
      --airspeed 22 --separation 80""",
        statuses=(
            """  3  a vehicle cannot be reached or refuses, or not all were in their slots
     at the end""",
            "  130  interrupted before anything was commanded",
        ),
    ),
)
