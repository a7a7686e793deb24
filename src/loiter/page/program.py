"""The command of this room, as the program lists it."""

from loiter.cli.command import PROGRAM, Command

COMMANDS = (
    Command(
        "serve",
        "loiter.page.server:serve",
        PROGRAM,
        120,
        help="""Open the page in the browser: it shows the plan while you drag the aircraft, the circle and the wind.""",
        examples=r"""
  loiter serve
  loiter serve --port 8080 --no-browser""",
    ),
)
