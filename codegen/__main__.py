"""`python -m codegen`: writes the files that are generated."""

from pathlib import Path

from codegen.files import files
from codegen.onboard import onboard_files
from codegen.onboard.lua_files import applet_files
from codegen.page import page_files


def write(texts: dict[Path, str]) -> None:
    """Write files."""
    for path, text in texts.items():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write(files() | onboard_files() | applet_files())
    # The page is bundled from the files above.
    write(page_files())
