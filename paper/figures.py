"""The figures of the paper, and the numbers in its text: `python paper/figures.py` writes paper/figures/*.png."""

from pathlib import Path

from loiter import Aircraft, Maneuver, Orbit, Pose, candidates, plan
from loiter.arrays.partition import boundaries, partition
from loiter.plot import picture, synthesis
from loiter.plot.files import save_figure

UAV, CIRCLE = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, radius_m=80.0)
START = Pose(east_m=90.0, north_m=60.0, heading_deg=100.0)


def other_direction(best: Maneuver) -> Maneuver:
    """The fastest entry in the other direction."""
    return plan(START, Orbit(0.0, 0.0, CIRCLE.radius_m, turn=best.turn.other), UAV)


def numbers() -> dict[str, str]:
    """The numbers that the text gives of the first figure, by what they are."""
    best = plan(START, CIRCLE, UAV)
    first, last = best.segments
    return {
        "right turn": f"right turn of {first.duration_s:.2f} s",
        "left turn": f"left turn of {last.duration_s:.2f} s",
        "duration": f"onto the {best.turn.described} circle in {best.duration_s:.2f} s",
        "other direction": f"would take {other_direction(best).duration_s - best.duration_s:.2f} s longer",
    }


def draw(folder: Path, cells: int = 400) -> list[Path]:
    """Write the figures; returns their files."""
    known = candidates(START, CIRCLE, UAV)
    regions = partition(radius=1.5, turn="cw", cells=cells)
    figures = {
        "entry.png": picture.draw(known[:1], known[1:]),
        "synthesis.png": synthesis.draw(regions, boundaries(regions)),
    }
    folder.mkdir(parents=True, exist_ok=True)
    for name, figure in figures.items():
        save_figure(folder / name, figure)
    return [folder / name for name in figures]


if __name__ == "__main__":
    for path in draw(Path(__file__).parent / "figures"):
        print(path)
