"""`python -m codegen.site FOLDER`: the built page as static files for any address.

A picture is shown beside a link to it, and a service worker keeps it for use without a network.
"""

import hashlib
import sys
from pathlib import Path

from codegen.page import BUILT, SOURCE

HEAD = """
<meta name="worker" content="worker.js">
<meta property="og:type" content="website">
<meta property="og:title" content="loiter: the fastest way onto a holding circle">
<meta property="og:description" content="Drag an aircraft: the fastest entry onto its holding circle, in wind too.">
<meta property="og:image" content="{address}preview.png">
<meta name="twitter:card" content="summary_large_image">"""


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
    charset = '<meta charset="utf-8">'
    page, tiles = ((BUILT / name).read_text("utf-8") for name in ("index.html", "map.html"))
    page = page.replace(charset, charset + HEAD.format(address=address), 1)
    version = hashlib.sha256((page + tiles).encode()).hexdigest()[:16]
    worker = (SOURCE / "worker.js").read_text("utf-8").replace("VERSION", version)
    for name, text in {"index.html": page, "map.html": tiles, "worker.js": worker}.items():
        (folder / name).write_text(text, encoding="utf-8")
    preview(folder / "preview.png")


if __name__ == "__main__":
    build(Path(sys.argv[1]), *sys.argv[2:])
