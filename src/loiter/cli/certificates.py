"""Output of `loiter plan --certify`: certificates as text, as JSON and as a picture."""

import sys
from collections.abc import Sequence
from pathlib import Path

from loiter.cli.options import PictureOptions
from loiter.verify.certificate import Certificate


def print_text(certificates: Sequence[Certificate]) -> None:
    """Print each certificate after an empty line."""
    for certificate in certificates:
        sys.stdout.write(f"\n{certificate}\n")


def document(certificates: Sequence[Certificate]) -> dict[str, object]:
    """The first certificate as a member of the JSON object; empty without one."""
    if not certificates:
        return {}
    first, *_ = certificates
    return {"certificate": first.to_dict()}


def picture_path(plot: Path) -> Path:
    """The file for the picture of the certificate: entry-certificate.png beside the plan's entry.png."""
    return plot.with_name(f"{plot.stem}-certificate{plot.suffix}")


def save_pictures(pictures: PictureOptions, certificates: Sequence[Certificate]) -> list[Path]:
    """Draw u, phi and psi of the first certificate, if any, to files beside the plan's; errors as for `files.save`.

    Returns the files of the plan and of the certificate.
    """
    # A path that arrives at a given time has no adjoint to draw.
    if not certificates or (certificates[0].maneuver.segments and not certificates[0].pieces):
        return [*pictures.plot]
    from loiter.plot.certificate import draw

    first, *_ = certificates
    pictures.save(draw(first), [*map(picture_path, pictures.plot)])
    return [file for path in pictures.plot for file in (path, picture_path(path))]
