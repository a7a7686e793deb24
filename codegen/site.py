"""`python -m codegen.site FOLDER`: the page as static files for any address: one HTML file with all that it needs.

esbuild bundles the modules; style and script stand in the HTML itself, so that the page is one request, opens from a
folder too, and a policy in its head allows its own code only. A service worker keeps it for use without a network.
"""

import hashlib
import re
import subprocess
import sys
from base64 import b64encode
from pathlib import Path

from codegen.unit import ROOT

STATIC = ROOT / "src" / "loiter" / "web" / "static"
ESBUILD = Path(sys.prefix) / "node" / "node_modules" / "esbuild" / "bin" / "esbuild"

# Nothing leaves the machine: tiles, once they are switched on, are loaded by the document of the map alone.
POLICY = (
    "default-src 'none'; script-src {script}; style-src {style}; img-src 'self' data: blob:; connect-src 'self'; "
    "worker-src 'self' blob:; frame-src 'self'; base-uri 'none'; form-action 'none'"
)
MAP_POLICY = "default-src 'none'; script-src {script}; style-src {style}; img-src http: https:; base-uri 'none'"

PREVIEW = """
<meta property="og:type" content="website">
<meta property="og:title" content="loiter: the fastest way onto a holding circle">
<meta property="og:description" content="Drag an aircraft: the fastest entry onto its holding circle, in wind too.">
<meta property="og:image" content="{address}preview.png">
<meta name="twitter:card" content="summary_large_image">
"""


# The headline of the first scene, to be read before the script has arrived; a link has another scene.
HEADLINE = '<p id="instruction">{text}</p><script>{script}</script>'
NO_HEADLINE = 'if(location.hash.length>1)document.getElementById("instruction").textContent=""'


def first_headline() -> str:
    """What the pilot does in the first scene of the page."""
    from loiter import Aircraft, Orbit, Pose, plan
    from loiter.web.answers.texts import instruction

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


def whole(document: str, entry: str, policy: str, head: str = "") -> str:
    """An HTML file with its style sheets and its script in itself."""
    text = (STATIC / document).read_text("utf-8")
    sheets = re.findall(r'<link rel="stylesheet" href="static/(.+?)">\n', text)
    text = re.sub(r'<link rel="stylesheet".+?>\n|<script.+?</script>\n', "", text).replace('"static/', '"')
    style, script = "".join(bundle(STATIC / sheet) for sheet in sheets), bundle(STATIC / entry)
    allowed = policy.format(script=f"{source(script)} {source(NO_HEADLINE)}", style=source(style))
    head = f'<meta http-equiv="Content-Security-Policy" content="{allowed}">{head}\n<style>{style}</style>'
    text = text.replace('<meta charset="utf-8">', f'<meta charset="utf-8">\n{head}')
    headline = HEADLINE.format(text=first_headline(), script=NO_HEADLINE)
    text = text.replace('<p id="instruction"></p>', headline)
    return text.replace("</body>", f"<script>{script}</script>\n</body>")


def preview(path: Path) -> None:
    """A picture of a plan, as large as links show one."""
    from matplotlib.figure import Figure

    from loiter import Aircraft, Orbit, Pose, Wind, plan
    from loiter.plot.picture import draw

    maneuver = plan(
        Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0), Wind(8.0, 250.0)
    )
    figure: Figure = draw([maneuver], [])
    figure.set_size_inches(12.0, 6.3)
    figure.savefig(path, dpi=100)


def build(folder: Path, address: str = "") -> None:
    """Write the site; `address` is where it will be, which some programs need to show its picture beside a link."""
    folder.mkdir(parents=True, exist_ok=True)
    page = whole("index.html", "site.js", POLICY, PREVIEW.format(address=address))
    tiles = whole("map.html", "tiles/tiles.js", MAP_POLICY)
    version = hashlib.sha256((page + tiles).encode()).hexdigest()[:16]
    worker = (STATIC / "worker.js").read_text("utf-8").replace("VERSION", version)
    files = {"index.html": page, "map.html": tiles, "worker.js": worker, "icon.svg": (STATIC / "icon.svg").read_text()}
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    preview(folder / "preview.png")


if __name__ == "__main__":
    build(Path(sys.argv[1]), *sys.argv[2:])
