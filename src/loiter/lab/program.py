"""The commands of this room, as the program lists them."""

from loiter.cli.command import FLIGHTS, Command

COMMANDS = (
    Command(
        "fly",
        "loiter.lab.fly:fly",
        FLIGHTS,
        70,
        help="""Simulate flights: a guidance law flies the fastest entry in closed loop, compared with the laws that autopilots use today.

One flight needs the same options as loiter plan; --runs flies from random starts. No vehicle is connected: for that there is loiter guide.""",
        examples=r"""
  loiter fly --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35 \
      --compare --plot flight.png
  loiter fly --pose -400 120 90 --orbit 0 0 200 --sim jsbsim
  loiter fly --runs 100 --compare --airspeed 18 --bank 35 --save runs.csv
  loiter fly --pose -400 120 90 --orbit 0 0 120 --airspeed 18 --bank 35 \
      --slot 200
  loiter fly --replay flight.csv --plot flight.png""",
    ),
)
