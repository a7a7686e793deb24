"""`python -m codegen`: writes the files that are generated."""

from codegen.files import files
from codegen.onboard import onboard_files
from codegen.onboard.lua_files import applet_files

if __name__ == "__main__":
    for path, text in (files() | onboard_files() | applet_files()).items():
        path.write_text(text, encoding="utf-8")
