"""The commands of this room, as the program lists them."""

from loiter.cli.command import PLANS, PROGRAM, THEORY, Command

COMMANDS = (
    Command(
        "plan",
        "loiter.cli.commands.plan:plan",
        PLANS,
        10,
        help="""Plan the fastest entry onto a holding circle: which turns to fly, for how long, and where to peel off.

It needs a start (--pose), a circle (--orbit), the airspeed, and one limit on the turn (--bank, --turn-radius or --turn-rate). Everything else is optional.""",
        examples=r"""
  loiter plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35
  loiter plan --pose -400 120 90 --orbit 0 0 80 --turn cw \
      --airspeed 18 --turn-radius 50 --plot entry.png
  loiter plan --pose -400 120 90 --orbit 0 0 120 --wind 8 250 \
      --airspeed 18 --bank 35 --certify
  loiter plan --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 \
      --airspeed 18 --bank 35 --altitude 900 --save entry.plan
  loiter plan --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 \
      --airspeed 18 --bank 35 --fence field.plan --margin 20""",
        statuses=("  1  a check failed: --certify or --fence",),
    ),
    Command(
        "leg",
        "loiter.cli.commands.legs:leg",
        PLANS,
        20,
        help="""Plan the fastest way in, round and out of a holding circle: the entry, how long to hold, and where to leave.

It needs what loiter plan needs, and the point to fly to afterwards (--exit-to). The aircraft leaves the circle on the tangent to that point, once the least hold, the turns and the altitude are reached; all of them together take the least time.""",
        examples=r"""
  loiter leg --pose -400 120 90 --orbit 0 0 80 --exit-to 600 0 \
      --airspeed 18 --bank 35 --hold 60 --plot leg.png
  loiter leg --pose -400 120 90 --orbit 0 0 120 --exit-to 600 0 \
      --airspeed 18 --bank 35 --wind 8 250 \
      --altitude 100 --to-altitude 300 --climb-rate 2.5""",
    ),
    Command(
        "synthesis",
        "loiter.cli.commands.synthesis:synthesis",
        THEORY,
        110,
        help="""Map the optimal synthesis of the reduced plane: the fastest word in each region, and the curves between the regions.""",
        examples=r"""
  loiter synthesis --radius 1.5 --turn cw --plot map.png
  loiter synthesis --plot map.pdf
  loiter synthesis --radius 2 --turn cw --show worth --save map.npz""",
    ),
    Command(
        "figures",
        "loiter.cli.commands.figures:figures",
        THEORY,
        120,
        help="""Draw the seven figures of the paper, and write their captions.""",
        examples=r"""
  loiter figures --out figures --format svg""",
    ),
    Command(
        "completion",
        "loiter.cli.commands.completion:completion",
        PROGRAM,
        130,
        help="""Print a completion script: `eval "$(loiter completion bash)"`.""",
        examples=r"""
  eval "$(loiter completion bash)"
  loiter completion fish > ~/.config/fish/completions/loiter.fish""",
    ),
)
