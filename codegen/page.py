"""The built page: one HTML file with all that it needs, and one for the map behind it.

esbuild bundles the modules; style and script stand in the HTML itself, so that the page is one request, opens from a
folder too, and a policy in its head allows its own code only.
"""

import hashlib
import re
import subprocess
import sys
from base64 import b64encode
from pathlib import Path

from codegen.unit import ROOT
from loiter import Aircraft, Orbit, Pose, plan
from loiter.page.answers.texts import instruction

SOURCE = ROOT / "src" / "loiter" / "page" / "source"
BUILT = ROOT / "src" / "loiter" / "page" / "built"
ESBUILD = Path(sys.prefix) / "node" / "node_modules" / "esbuild" / "bin" / "esbuild"

# Nothing leaves the machine: tiles, once they are switched on, are loaded by the document of the map alone.
POLICY = (
    "default-src 'none'; script-src {script}; style-src {style}; img-src 'self' data: blob:; connect-src 'self'; "
    "worker-src 'self' blob:; frame-src 'self'; base-uri 'none'; form-action 'none'"
)
MAP_POLICY = "default-src 'none'; script-src {script}; style-src {style}; img-src http: https:; base-uri 'none'"

# The headline of the first scene, to be read before the script has arrived; a link has another scene.
HEADLINE = '<p id="instruction">{text}</p><script>{script}</script>'
NO_HEADLINE = 'if(location.hash.length>1)document.getElementById("instruction").textContent=""'


def first_headline() -> str:
    """What the pilot does in the first scene of the page."""
    text = instruction(plan(Pose(90.0, 60.0, 100.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0)))
    now, _, hold = text.replace(" s", "\u00a0s").partition("\u00a0s. Hold")
    return f'{now}\u00a0s. <span class="hold">Hold{hold}</span>'


def bundle(entry: Path) -> str:
    """A module and all that it imports, or a style sheet, minified."""
    options = ["--bundle", "--minify", "--format=iife", "--target=es2022", "--log-level=warning"]
    return subprocess.run([ESBUILD, entry, *options], stdout=subprocess.PIPE, check=True).stdout.decode().strip()


def source(text: str) -> str:
    """The hash by which a policy allows a script or a style."""
    return f"'sha256-{b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def whole(document: str, entry: str, policy: str) -> str:
    """An HTML file with its icon, its style sheets and its script in itself."""
    text = (SOURCE / document).read_text("utf-8")
    sheets = re.findall(r'<link rel="stylesheet" href="(.+?)">\n', text)
    text = re.sub(r'<link rel="stylesheet".+?>\n', "", text)
    icon = b64encode((SOURCE / "icon.svg").read_bytes()).decode()
    text = text.replace('"icon.svg"', f'"data:image/svg+xml;base64,{icon}"')
    style, script = "".join(bundle(SOURCE / sheet) for sheet in sheets), bundle(SOURCE / entry)
    allowed = policy.format(script=f"{source(script)} {source(NO_HEADLINE)}", style=source(style))
    head = f'<meta http-equiv="Content-Security-Policy" content="{allowed}">\n<style>{style}</style>'
    text = text.replace('<meta charset="utf-8">', f'<meta charset="utf-8">\n{head}')
    headline = HEADLINE.format(text=first_headline(), script=NO_HEADLINE)
    text = text.replace('<p id="instruction"></p>', headline)
    return text.replace("</body>", f"<script>{script}</script>\n</body>")


def page_files() -> dict[Path, str]:
    """The files of the built page."""
    if not ESBUILD.exists():
        raise SystemExit(f"{ESBUILD} is missing: make .venv/node.stamp installs it")
    return {
        BUILT / "index.html": whole("index.html", "entry.js", POLICY),
        BUILT / "map.html": whole("map.html", "tiles/tiles.js", MAP_POLICY),
    }
