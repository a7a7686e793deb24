"""The manual page docs/loiter.1, which the wheel installs as share/man/man1/loiter.1, from the help of the commands.

`python tests/golden/build_man.py` writes it anew.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from cyclopts import App
from cyclopts.argument import Argument

from loiter.cli.app import app, shown_default
from loiter.cli.command import EPILOGUE, commands

EXAMPLES = {command.name: command.examples for command in commands()}
DOCUMENT = Path(__file__).parents[2] / "docs" / "loiter.1"


def roff(text: str) -> str:
    """Text with roff's special characters escaped."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-").replace("°", "\\[de]")
    return "\n".join(f"\\&{line}" if line.startswith((".", "'")) else line for line in escaped.splitlines())


OPTIONAL = "[\\fIOPTIONS\\fR]"


def bold(text: str) -> str:
    return "\\fB" + roff(text) + "\\fR"


def italic(text: str) -> str:
    return "\\fI" + roff(text) + "\\fR"


def paragraphs(text: str) -> Iterator[str]:
    for paragraph in filter(str.strip, text.split("\n\n")):
        yield f".PP\n{roff(' '.join(paragraph.split()))}"


def as_it_stands(text: str) -> str:
    """Lines that are not filled."""
    return f".PP\n.nf\n{roff(text.strip(chr(10)))}\n.fi"


def option(argument: Argument) -> str:
    """An option with its values, its help and its default."""
    names = ", ".join(bold(name) for name in argument.names if not name.startswith(("--no-", "--empty-")))
    choices = argument.get_choices() or ()
    flag = argument.is_flag()
    metavar = argument.parameter.metavar or ("" if flag or not argument.name.startswith("-") else "|".join(choices))
    default = None if argument.required else shown_default(argument.field_info.default)
    help_text = roff(" ".join((argument.parameter.help or "").split()))
    help_text += f" Default: {roff(default)}." if default else ""
    return f".TP\n{names}{f' {italic(metavar)}' if metavar else ''}\n{help_text}"


def options(command: App) -> Iterator[str]:
    """The options of a command, group by group, in the order of its help."""
    groups: dict[str, list[Argument]] = {}
    order: dict[str, float] = {}
    for argument in command.assemble_argument_collection(parse_docstring=True):
        if argument.show and argument.names != ("*",):
            group, *_ = argument.parameter.group
            groups.setdefault(group.name, []).append(argument)
            order[group.name] = group.sort_key if isinstance(group.sort_key, (int, float)) else -1.0
    for name in sorted(groups, key=order.__getitem__):
        if name not in ("Parameters", "Arguments"):
            yield f".PP\n{italic(name)}"
        yield from map(option, groups[name])


def section(name: str) -> Iterator[str]:
    """A command: its help, its options and its examples."""
    command = app[name]
    arguments = [a for a in command.assemble_argument_collection() if a.show and not a.names[0].startswith("-")]
    words = [italic(a.names[0]) if a.required else f"[{italic(a.names[0])}]" for a in arguments if a.names != ("*",)]
    yield f'.SS "loiter {name}"'
    yield f".PP\n{' '.join([bold(f'loiter {name}'), *words, OPTIONAL])}"
    yield from paragraphs(command.help)
    yield from options(command)
    yield as_it_stands(EXAMPLES[name])


def build() -> str:
    names = [name for name in app if not name.startswith("-")]
    lines = [
        f'.TH LOITER 1 "" "loiter {app.version}" "User Commands"',
        ".SH NAME\nloiter \\- the fastest way onto a holding circle for a fixed-wing aircraft",
        ".SH SYNOPSIS\n\\fBloiter\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]",
        ".br\n\\fBloiter\\fR [\\fICOMMAND\\fR] \\fB\\-\\-help\\fR",
        ".br\n\\fBloiter\\fR \\fB\\-\\-version\\fR",
        ".SH DESCRIPTION",
        *paragraphs(app.help),
        ".SH COMMANDS",
        *(line for name in names for line in section(name)),
        ".SH EXIT STATUS",
        as_it_stands(EPILOGUE.partition("Exit status\n")[2]),
    ]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    DOCUMENT.write_text(build(), encoding="utf-8")
