"""The end of a help text: examples of the command, and the meaning of exit statuses."""

# Examples of each command; continuation lines are indented.
EXAMPLES = {
    "plan": r"""
  loiter plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35
  loiter plan --pose -400 120 90 --orbit 0 0 80 --turn cw \
      --airspeed 18 --turn-radius 50 --plot entry.png
  loiter plan --pose -400 120 90 --orbit 0 0 120 --wind 8 250 \
      --airspeed 18 --bank 35 --certify
  loiter plan --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 \
      --airspeed 18 --bank 35 --altitude 900 --save entry.plan
  loiter plan --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 \
      --airspeed 18 --bank 35 --fence field.plan --margin 20""",
    "leg": r"""
  loiter leg --pose -400 120 90 --orbit 0 0 80 --exit-to 600 0 \
      --airspeed 18 --bank 35 --hold 60 --plot leg.png
  loiter leg --pose -400 120 90 --orbit 0 0 120 --exit-to 600 0 \
      --airspeed 18 --bank 35 --wind 8 250 \
      --altitude 100 --to-altitude 300 --climb-rate 2.5""",
    "fleet": r"""
  loiter fleet fleet.csv --orbit 0 0 120 --airspeed 18 --bank 35 \
      --separation 100 --plot fleet.png
  loiter fleet fleet.csv --orbit-lla 47.11 8.23 120 --airspeed 18 \
      --bank 35 --wind 8 250 --altitude 900 --save fleet.kml""",
    "land": r"""
  loiter land --pose -400 900 90 --altitude 650 --runway 0 0 90 \
      --elevation 500 --radius 120 --final 500 \
      --airspeed 18 --bank 35 --descent-rate 3
  loiter land --pose-lla 47.01 8.02 270 --altitude 700 \
      --runway-lla 47.0 8.0 90 --elevation 500 --radius 120 --final 800 \
      --airspeed 18 --bank 35 --descent-rate 3 --save landing.plan""",
    "batch": r"""
  loiter batch states.parquet entries/ --orbit 0 0 80 \
      --airspeed 18 --bank 35
  loiter batch states.csv entries.csv --airspeed 18 --turn-radius 50 \
      --wind 8 250 --workers 4
  loiter batch 's3://tables/states-*.parquet' s3://tables/entries/ \
      --orbit 0 0 80 --airspeed 18 --bank 35""",
    "upload": r"""
  loiter upload --connect udpin:127.0.0.1:14550 --pose-lla 47.1 8.2 90 \
      --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35 --altitude 900
  loiter upload entry.plan --connect /dev/ttyUSB0,57600""",
    "watch": r"""
  loiter watch --connect udpin:127.0.0.1:14550 \
      --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35
  loiter watch --connect udpin:127.0.0.1:14550 --reports 10 \
      --orbit-lla 47.11 8.23 --params uav.param""",
    "guide": r"""
  loiter guide --connect udpin:127.0.0.1:14550 --orbit-lla 47.11 8.23 120
  loiter guide --connect tcp:127.0.0.1:5762 --dry-run \
      --orbit-lla 47.11 8.23 120 --turn ccw --bank 40
  loiter guide --connect udpin:127.0.0.1:14550 --orbit-lla 47.11 8.23 120 \
      --turn cw --airspeed 22 --slot 90 --slot-at 1790000000
  loiter guide --fleet vehicles.csv --orbit-lla 47.11 8.23 120 \
      --airspeed 22 --separation 80
  loiter guide --connect /dev/ttyUSB0,57600 --orbit-lla 47.11 8.23 120 \
      --altitude 900 --keep --log flight.csv""",
    "fly": r"""
  loiter fly --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35 \
      --compare --plot flight.png
  loiter fly --pose -400 120 90 --orbit 0 0 200 --sim jsbsim
  loiter fly --runs 100 --compare --airspeed 18 --bank 35 --save runs.csv
  loiter fly --pose -400 120 90 --orbit 0 0 120 --airspeed 18 --bank 35 \
      --slot 200
  loiter fly --replay flight.csv --plot flight.png""",
    "synthesis": r"""
  loiter synthesis --radius 1.5 --turn cw --plot map.png
  loiter synthesis --plot map.pdf
  loiter synthesis --radius 2 --turn cw --show worth --save map.npz""",
    "figures": r"""
  loiter figures --out figures --format svg""",
    "serve": r"""
  loiter serve
  loiter serve --port 8080 --cors http://localhost:8000""",
    "completion": r"""
  eval "$(loiter completion bash)"
  loiter completion fish > ~/.config/fish/completions/loiter.fish""",
}

# The commands of a text that only the help of the program shows.
PROGRAM_ONLY = ("",)

# Each exit status as the help shows it, and the commands that end with it; no commands: all. The help of the program
# shows the first text of each.
STATUSES: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("  0  done", ()),
    ("  1  a check failed: loiter plan --certify or --fence", ("plan",)),
    (
        """  2  the request cannot be met: one sentence on standard error says why,
     and no file is left half written""",
        (),
    ),
    (
        """  3  the vehicle cannot be reached, does not answer or refuses, or guiding
     had to stop: the sentence says what the vehicle has or does now; of a
     fleet, not all were in their slots at the end""",
        ("guide",),
    ),
    (
        """  3  the vehicle cannot be reached, does not answer or refuses: the sentence
     says what it has now""",
        ("upload", "watch"),
    ),
    (
        """  130  interrupted; finished parts of a batch job are kept, and a guided
     vehicle flies its fall-back circle""",
        PROGRAM_ONLY,
    ),
    (
        """  130  interrupted; finished parts of a batch job are kept""",
        ("batch",),
    ),
    (
        """  130  interrupted; a guided vehicle flies its fall-back circle""",
        ("guide",),
    ),
)

_OF_THE_PROGRAM = {text.split()[0]: text for text, _ in reversed(STATUSES)}
EXIT_STATUSES = "\n".join(("\n\nExit status", *reversed(_OF_THE_PROGRAM.values())))


def epilogue(command: str) -> str:
    """The end of the help text of a command: its examples and its exit statuses."""
    shown = (text for text, commands in STATUSES if not commands or command in commands)
    return "\n".join((f"Examples{EXAMPLES[command]}", "", "Exit status", *shown))


def program_epilogue(*commands: str) -> str:
    """The end of the help text of the program: the examples of the commands, and all exit statuses."""
    return f"Examples{''.join(EXAMPLES[command] for command in commands)}{EXIT_STATUSES}"
