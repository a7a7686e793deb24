"""The certificate that `loiter plan --certify` adds, as text and as a picture."""

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
    """The file of the certificate's picture: entry-certificate.png beside entry.png."""
    return plot.with_name(f"{plot.stem}-certificate{plot.suffix}")


def save_picture(plot: Path, certificate: Certificate) -> None:
    """Draw u, phi and psi over time to a file beside the plan's picture; raises as `files.save_figure`."""
    from loiter.plot.certificate import draw

    files.save_figure("plot", picture_path(plot), draw(certificate))
