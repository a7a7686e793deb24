"""The size and the resolution of pictures, as journals ask for them: width and height in millimetres, dots per inch."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING

from loiter.errors import InvalidArgument, number

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend
    from matplotlib.text import Annotation, Text

MM_PER_INCH = 25.4

# In smaller pictures the axes have no room beside their labels; columns of journals are some 84 mm wide. The largest
# side is that of A0 paper.
LEAST_WIDTH_MM, LEAST_HEIGHT_MM, LARGEST_MM = 80.0, 60.0, 1189.0

# A picture of a flight has three panels, one above the other.
LEAST_FLIGHT_HEIGHT_MM = 110.0

# The resolution where none is given, and its limits: journals ask for at most 1200.
DPI = 150.0
LEAST_DPI, LARGEST_DPI = 30.0, 1200.0

# A larger PNG would need more than 800 MB of memory while it is written: A0 at 300 dots per inch has 140e6.
MOST_PIXELS = 200e6

# Text shrinks in narrow pictures, but not below 7 points, the least that journals accept.
LEAST_SHRINKING, LEAST_POINTS = 0.7, 7.0

# In a narrow picture a legend with more entries than this would hide what it explains.
MOST_ENTRIES = 3

# In a figure that is wider than so many times its height, a legend is moved beside the axes.
BESIDE_IF_WIDER = 1.8

# The gid of a legend that moves out of the axes of a narrow figure however few its entries.
OUTSIDE_IF_NARROW = "legend outside if narrow"

# The shortest line of a title that is broken.
LEAST_LETTERS = 20

# Between the base line of a title and the label below it, points: descenders need half of it.
TITLE_GAP = 6.0


@dataclass(frozen=True)
class PictureFormat:
    """The width and height of a picture, millimetres, and its resolution, dots per inch; None: its own, and `DPI`.

    Raises `InvalidArgument` for a size or a resolution beyond the limits above, and for too many pixels.
    """

    size_mm: tuple[float, float] | None = None
    dpi: float | None = None

    def __post_init__(self) -> None:
        if self.dpi is not None:
            object.__setattr__(self, "dpi", _within("dpi", self.dpi, LEAST_DPI, LARGEST_DPI, "dots per inch"))
        if self.size_mm is None:
            return
        width_mm, height_mm = _sides(self.size_mm)
        object.__setattr__(self, "size_mm", (width_mm, height_mm))
        pixels = width_mm * height_mm * (self.resolution / MM_PER_INCH) ** 2
        if pixels > MOST_PIXELS:
            raise InvalidArgument(
                "dpi",
                f"is {self.resolution:g}: with a size of {width_mm:g} x {height_mm:g} mm a picture would have "
                f"{pixels / 1e6:.0f} million pixels, and may have {MOST_PIXELS / 1e6:.0f} million",
            )

    @property
    def resolution(self) -> float:
        """Dots per inch: as given, or `DPI`."""
        return DPI if self.dpi is None else self.dpi

    def apply(self, figure: Figure) -> None:
        """Give a figure this size and, where it is given, this resolution."""
        if self.size_mm is not None:
            resize(figure, *self.size_mm)
        if self.dpi is not None:
            figure.set_dpi(self.dpi)


def resize(figure: Figure, width_mm: float, height_mm: float) -> None:
    """Give a figure another width and height, in which its text stays legible.

    If it becomes narrower, text, lines and marks shrink to 70 % at the least, text not below 7 points; long legends
    move below the figure; a title has more lines, and moves above the labels that it would cover. Raises
    `InvalidArgument` for a width below 80 mm, a height below 60 mm, and above 1189 mm.
    """
    width_mm, height_mm = _sides((width_mm, height_mm))
    before_mm = figure.get_figwidth() * MM_PER_INCH
    figure.set_size_inches(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH)
    if width_mm < before_mm:
        _shrink(figure, max(LEAST_SHRINKING, width_mm / before_mm))
        _move_legends(figure)
        _wrap_titles(figure)
        _raise_titles(figure)


def _shrink(figure: Figure, factor: float) -> None:
    """Make text, lines, marks and arrows smaller."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import FancyArrowPatch
    from matplotlib.text import Annotation, Text

    for text in figure.findobj(Text):
        points = float(text.get_fontsize())  # a number, also where the size was set by name
        text.set_fontsize(max(min(LEAST_POINTS, points), factor * points))
        if isinstance(text, Annotation):
            _shrink_annotation(text, factor)
    for line in figure.findobj(Line2D):
        line.set_linewidth(factor * line.get_linewidth())
        line.set_markersize(factor * line.get_markersize())
    for arrow in figure.findobj(FancyArrowPatch):
        arrow.set_linewidth(factor * arrow.get_linewidth())
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        # For ticks that are added when the figure is drawn.
        first, *_ = axis.get_major_ticks(1)
        axis.set_tick_params(labelsize=first.label1.get_fontsize())


def _shrink_annotation(annotation: Annotation, factor: float) -> None:
    """Make the arrow of an annotation smaller, and move both nearer to the corner from which they are measured."""
    from matplotlib.text import OffsetFrom

    # The annotation gives the arrow patch this size whenever it is drawn.
    if annotation.arrowprops and "mutation_scale" in annotation.arrowprops:
        annotation.arrowprops["mutation_scale"] *= factor
    if isinstance(annotation.xycoords, OffsetFrom):
        annotation.xy, annotation.xyann = ((factor * x, factor * y) for x, y in (annotation.xy, annotation.xyann))


def _move_legends(figure: Figure) -> None:
    """Move the legends with many entries out of their axes."""
    for axes in figure.axes:
        legend = axes.get_legend()
        if legend is None:
            continue
        if legend.get_gid() == OUTSIDE_IF_NARROW or len(legend.get_texts()) > MOST_ENTRIES:
            _legend_outside(figure, legend)
            legend.remove()


def _legend_outside(figure: Figure, legend: Legend) -> None:
    """Add the legend beside the axes or, in as many columns as there is room, below them."""
    first, *_ = texts = legend.get_texts()
    handles = [handle for handle in legend.legend_handles if handle is not None]
    labels, points = [text.get_text() for text in texts], first.get_fontsize()
    if figure.get_figwidth() > BESIDE_IF_WIDER * figure.get_figheight():
        figure.legend(handles, labels, loc="outside right upper", fontsize=points)
        return
    for columns in (3, 2, 1):
        below = figure.legend(handles, labels, loc="outside lower center", ncols=columns, fontsize=points)
        if columns == 1 or _width_of(figure, below) < figure.bbox.width:
            return
        below.remove()


def _width_of(figure: Figure, legend: Legend) -> float:
    """The width of a legend, in pixels. The layout is left out: it warns where a legend has no room."""
    layout = figure.get_layout_engine()
    figure.set_layout_engine("none")
    figure.draw_without_rendering()
    figure.set_layout_engine(layout)
    return legend.get_window_extent().width


def _titles(figure: Figure) -> list[Text]:
    """The titles of the axes, and that of the figure."""
    return [*(axes.title for axes in figure.axes), *figure.texts]


def _wrap_titles(figure: Figure) -> None:
    """Break the lines of titles that are cut at the edge of the figure."""
    figure.draw_without_rendering()
    for title in _titles(figure):
        lines = title.get_text().split("\n")
        for letters in range(max(map(len, lines)), LEAST_LETTERS, -1):
            box = title.get_window_extent()
            if box.x0 >= 0.0 and box.x1 <= figure.bbox.width:
                break
            title.set_text("\n".join(part for line in lines for part in _balanced(line, letters)))


def _balanced(line: str, letters: int) -> list[str]:
    """A line in as few parts of at most so many letters as possible, none much shorter than the others."""
    longest_word = max(map(len, line.split()), default=1)
    widths = range(min(longest_word, letters), letters + 1)
    return min((wrap(line, width) for width in widths), key=len)


def _raise_titles(figure: Figure) -> None:
    """Move the titles of axes that cover labels beside them, such as that of the wind, above these labels."""
    figure.draw_without_rendering()
    for axes in figure.axes:
        title = axes.title.get_window_extent()
        tops = [box.y1 for text in axes.texts if (box := text.get_window_extent()).overlaps(title)]
        if tops and axes.get_title():
            points = (max(tops) - axes.bbox.y1) * 72.0 / figure.dpi
            axes.set_title(axes.get_title(), pad=points + TITLE_GAP, fontsize=axes.title.get_fontsize())


def _sides(size_mm: tuple[float, float]) -> tuple[float, float]:
    """The width and the height, checked."""
    try:
        width_mm, height_mm = size_mm
    except (TypeError, ValueError):
        raise InvalidArgument("size_mm", f"is {size_mm!r}: it must be a width and a height, millimetres") from None
    return (
        _within("size_mm width", width_mm, LEAST_WIDTH_MM, LARGEST_MM, "millimetres"),
        _within("size_mm height", height_mm, LEAST_HEIGHT_MM, LARGEST_MM, "millimetres"),
    )


def _within(argument: str, value: object, least: float, largest: float, unit: str) -> float:
    checked = number(argument, value, unit)
    if not least <= checked <= largest:
        raise InvalidArgument(argument, f"is {checked:g}: it must be from {least:g} to {largest:g} {unit}")
    return checked
