"""What `loiter plan --certify` adds: the certificate as text and as a picture."""

import sys
from collections.abc import Sequence
from pathlib import Path

from loiter.plot import files
from loiter.verify.certificate import Certificate


def print_text(certificates: Sequence[Certificate]) -> None:
    """Print each certificate after an empty line."""
    for certificate in certificates:
        sys.stdout.write(f"\n{certificate}\n")


def picture_path(plot: Path) -> Path:
    """Where the picture of the certificate goes: entry.png beside it is entry-certificate.png."""
    return plot.with_name(f"{plot.stem}-certificate{plot.suffix}")


def save_picture(plot: Path, certificate: Certificate) -> None:
    """Draw u, phi and psi over time to a file beside the plan's; errors as `files.save`."""
    from loiter.plot.certificate import draw

    files.save_figure("plot", picture_path(plot), draw(certificate))
