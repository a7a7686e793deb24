"""The map of the folders in docs/design.md, from the docstrings of the modules.

`python tests/golden/build_design.py` writes it anew; a test holds the document against it.
"""

import ast
from pathlib import Path

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "loiter"
DOCUMENT = ROOT / "docs" / "design.md"
BEGIN, END = "<!-- From the docstrings: tests/golden/build_design.py -->\n", "<!-- End of the map -->\n"

# From the mathematics up to the front ends.
ORDER = [
    "kernel",
    "compiled",
    "planning",
    "arrays",
    "geo",
    "fences",
    "verify",
    "evidence",
    "guidance",
    "batch",
    "io",
    "plot",
]
ORDER += ["mavlink", "web", "cli"]


def summary(path: Path) -> str:
    """The first sentence of a module's docstring, without its full stop."""
    text = ast.get_docstring(ast.parse(path.read_text("utf-8"))) or ""
    return " ".join(text.partition("\n\n")[0].split()).rstrip(".")


def table(folder: Path) -> str:
    """The rows of a folder: its modules."""
    rows = {path.stem: summary(path) for path in sorted(folder.glob("*.py")) if path.name != "__init__.py"}
    lines = [f"| `{name}.py` | {text} |" for name, text in rows.items()]
    return "\n".join(["| | |", "|---|---|", *lines])


def folders() -> list[Path]:
    """The package, and every folder of it with modules, in the order of the layers."""
    found = [SOURCE]
    for name in ORDER:
        found += [path.parent for path in sorted((SOURCE / name).rglob("__init__.py"))]
    return found


def section(folder: Path) -> str:
    title = "loiter" if folder == SOURCE else f"loiter/{folder.relative_to(SOURCE)}"
    return f"### `{title}`\n\n{summary(folder / '__init__.py')}.\n\n{table(folder)}\n"


def build() -> str:
    """The map as it stands between the two comments of the document."""
    return "\n" + "\n".join(map(section, folders())) + "\n"


def split(document: str) -> tuple[str, str, str]:
    """The document before the map, the map, and the document after it."""
    before, _, rest = document.partition(BEGIN)
    found, _, after = rest.partition(END)
    return before, found, after


if __name__ == "__main__":
    before, _, after = split(DOCUMENT.read_text("utf-8"))
    DOCUMENT.write_text(before + BEGIN + build() + END + after, encoding="utf-8")
