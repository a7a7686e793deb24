"""`make verify`: the answers compared with independent methods, five in still air and one in wind."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Annotated, Any, Literal, NamedTuple

from cyclopts import Parameter
from rich.console import Console
from rich.progress import track
from rich.table import Table

from loiter.cli import report
from loiter.cli.numbers import whole
from loiter.cli.status import CHECK_FAILED

# Grids of the reachability map: the finer one shows that the difference falls with the spacing.
CELLS = (40, 80)

Method = Literal["search", "digits", "collocation", "reachability", "wind", "rolling"]

# The methods that run if none is named. The others take half a second and more per problem.
DEFAULTS: tuple[Method, ...] = ("search", "digits", "collocation", "reachability")

# Number of random problems if none is given, in still air and in wind.
STATES, WINDY_STATES = 2000, 20


Row = dict[str, str | int | float | bool]


class Findings(NamedTuple):
    """The result of one method: rows with the same keys, a note on them, and whether all answers agree.

    The keys are the headings of the table, with underscores.
    """

    rows: list[Row]
    note: str
    passed: bool

    def document(self, method: str) -> dict[str, object]:
        """The result as plain values; an unknown number is None."""
        rows = [{key: report.json_value(value) for key, value in row.items()} for row in self.rows]
        return {"method": method, "agrees": self.passed, "rows": rows, "note": self.note}

    def table(self) -> Table:
        """The result as a table, its columns with numbers on the right."""
        table, (first, *_) = report.new_table(), self.rows
        for key in first:
            table.add_column(key.replace("_", " "), justify="left" if key == next(iter(first)) else "right")
        for row in self.rows:
            table.add_row(*(_shown(key, value) for key, value in row.items()))
        return table


# Decimals of the numbers that are not tiny, by key; the others have an exponent.
DECIMALS = {
    "later_by_s": 2,
    "at_most_s": 2,
    "at_least_s": 2,
    "gap_s": 3,
    "gap_at_most_s": 3,
    "spacing": 3,
    "mean_difference": 3,
    "share_of_allowed": 2,
}


def _shown(key: str, value: str | int | float | bool) -> str:
    """A value as text in a table."""
    if isinstance(value, bool):
        return "yes" if value else "NO"
    if isinstance(value, float):
        return f"{value:.{DECIMALS[key]}f}" if key in DECIMALS else f"{value:.1e}"
    return str(value)


def verify(
    *,
    states: Annotated[
        int | None,
        Parameter(
            metavar="N",
            converter=whole,
            help=f"Number of random problems: for search and for digits ({STATES} if absent), and for wind "
            f"({WINDY_STATES} if absent).",
        ),
    ] = None,
    cases: Annotated[
        int, Parameter(metavar="N", converter=whole, help="Random problems for collocation and for rolling.")
    ] = 50,
    seed: Annotated[int, Parameter(metavar="N", converter=whole, help="The same seed draws the same problems.")] = 0,
    witness: Annotated[
        list[Method] | None, Parameter(metavar="NAME", help="Compare with this method only; may be repeated.")
    ] = None,
    json: Annotated[bool, Parameter(help="Print one JSON object with the results of all methods.")] = False,
) -> int:
    """Compare plans with independent methods; exit status 1 where one of them disagrees.

    search: OMPL's Dubins distance, minimised over the point of joining. digits: the kernel's own functions in 50 digits
    (mpmath). collocation: time-optimal control as a nonlinear program (CasADi, IPOPT), for the paper's examples and
    random problems. reachability: the Hamilton-Jacobi equation on a grid of the reduced plane (hj-reachability). wind:
    a search over points of joining and times in wind. rolling: what an aircraft can reach whose bank changes at a
    limited rate, wings level at first, between a path that it can fly and a proved lower bound. These two are slow,
    and run only where they are named.
    """
    names = witness or DEFAULTS
    # Each method raises where its packages are not installed, before the first one starts.
    comparisons = [_METHODS[name](_states(name, states), cases, seed) for name in names]
    findings = {name: compare() for name, compare in zip(names, comparisons, strict=True)}
    passed = all(found.passed for found in findings.values())
    if json:
        methods = [found.document(name) for name, found in findings.items()]
        report.print_json({"agrees": passed, "methods": methods})
    else:
        for name, found in findings.items():
            report.write(f"{name}: {'agrees' if found.passed else 'DISAGREES'}", found.table(), found.note, "")
    return 0 if passed else CHECK_FAILED


def _states(method: Method, states: int | None) -> int:
    """The number of problems: as given, or the method's default."""
    if states is not None:
        return states
    return WINDY_STATES if method == "wind" else STATES


def _with_progress(name: str, results: Iterable[Any], total: int) -> Iterator[Any]:
    # The progress goes to standard error, so that standard output contains the result only.
    return iter(track(results, description=name, total=total, console=Console(stderr=True)))


def _search(states: int, cases: int, seed: int) -> Callable[[], Findings]:
    from evidence.checks.oracle_check import RESOLUTION, compare_with_oracle

    note = "Largest differences, over turn radius plus length"
    return _against_search("search", compare_with_oracle(states, seed), states, RESOLUTION, note)


def _against_search(
    name: str, results: Iterable[Any], states: int, resolution: float, note: str, **columns: str
) -> Callable[[], Findings]:
    """Compare plans with a search that resolves times to `resolution`; `columns` are further fields of its results."""

    def compare() -> Findings:
        found = list(_with_progress(name, results, states))
        rows: list[Row] = []
        for place, here in _by_place([(d.problem.place, d) for d in found]):
            beyond = sum(max(d.later, d.earlier) > resolution for d in here)
            more = {column: float(max(getattr(d, field) for d in here)) for column, field in columns.items()}
            later: Row = {"plan_later_by": float(max(d.later for d in here))}
            earlier: Row = {"search_later_by": float(max(d.earlier for d in here))}
            rows.append({"place": place, "scenes": len(here), **later, **earlier, "beyond": int(beyond), **more})
        passed = all(max(d.later, d.earlier) <= resolution for d in found)
        return Findings(rows, f"{note}; the search resolves {resolution:.0e}.", passed)

    return compare


def _digits(states: int, cases: int, seed: int) -> Callable[[], Findings]:
    from evidence.checks.precision import WIDE, WORST, RoundingError, precision

    results = precision(states, seed)

    def compare() -> Findings:
        found: list[RoundingError] = list(_with_progress("digits", results, states))
        rows: list[Row] = []
        for place, here in _by_place([(r.place, r) for r in found]):
            beyond = sum(not r.passed for r in here)
            errors: Row = {"largest_error": float(max(r.error for r in here))}
            share = float(max(r.share for r in here))
            rows.append({"next_to": place, "states": len(here), **errors, "share_of_allowed": share, "beyond": beyond})
        note = (
            f"Rounding of T, relative, within 1e-12 to 1e-7 of each boundary; {WORST:.0e} is allowed, R/{WIDE:g} times "
            f"that on circles of more than {WIDE:g} turn radii; share: the largest share of what is allowed."
        )
        return Findings(rows, note, all(r.passed for r in found))

    return compare


def _collocation(states: int, cases: int, seed: int) -> Callable[[], Findings]:
    from evidence.checks.collocation_check import CollocationDifference, compare_with_collocation

    results = compare_with_collocation(cases, seed)

    def compare() -> Findings:
        found: list[CollocationDifference] = list(_with_progress("collocation", results, cases + 2))
        rows: list[Row] = []
        for place, here in _by_place([(c.problem.place, c) for c in found]):
            later, earlier = max(0.0, *(c.later for c in here)), max(0.0, *(-c.later for c in here))
            same = sum(c.same_structure for c in here)
            times: Row = {"plan_later_by": later, "program_later_by": earlier}
            rows.append({"scene": place, "solves": len(here), **times, "same_structure": same})
        note = "Largest differences in turn radii over airspeed, each within the program's own error bound."
        return Findings(rows, note, all(c.passed for c in found))

    return compare


def _reachability(states: int, cases: int, seed: int) -> Callable[[], Findings]:
    from evidence.checks.reachability_check import MAPS, ReachabilityDifference, compare_with_reachability

    results = compare_with_reachability(CELLS)

    def compare() -> Findings:
        found: list[ReachabilityDifference] = list(_with_progress("reachability", results, len(CELLS) * len(MAPS)))
        rows: list[Row] = []
        for m in found:
            grid: Row = {"map": f"R = {m.radius:g}, {m.turn.value}", "spacing": float(m.spacing), "nodes": int(m.nodes)}
            difference: Row = {"where_T_is_steep": int(m.beside_jumps), "mean_difference": float(m.difference)}
            rows.append({**grid, **difference, "within_bounds": bool(m.passed)})
        note = "Mean difference of T from the grid's, whose error falls with the spacing to the power 5/6 at kinks."
        return Findings(rows, note, all(m.passed for m in found))

    return compare


def _wind(states: int, cases: int, seed: int) -> Callable[[], Findings]:
    from evidence.checks.wind_scan_check import RESOLUTION, WINDIEST, compare_with_scan

    note = f"Largest differences of T over 1 + T in wind up to {WINDIEST:g} of the airspeed"
    results = compare_with_scan(states, seed)
    return _against_search("wind", results, states, RESOLUTION, note, ends_off_by="missed")


def _rolling(states: int, cases: int, seed: int) -> Callable[[], Findings]:
    from evidence.checks.rolling_check import AIRCRAFT, RATES_DEG_S, RollingBound, compare_with_rolling

    results = compare_with_rolling(cases, seed)

    def compare() -> Findings:
        found: list[RollingBound] = list(_with_progress("rolling", results, cases * len(RATES_DEG_S)))
        rows: list[Row] = []
        for place in dict.fromkeys(bound.problem.place for bound in found):
            here = [bound for bound in found if bound.problem.place == place]
            later_s = sorted(bound.later_s for bound in here)
            later: Row = {"later_by_s": later_s[len(later_s) // 2], "at_most_s": later_s[-1], "at_least_s": later_s[0]}
            gaps_s = sorted(bound.gap_s for bound in here)
            gap: Row = {"gap_s": gaps_s[len(gaps_s) // 2], "gap_at_most_s": gaps_s[-1]}
            misses: Row = {"missed": max(bound.missed for bound in here)}
            rows.append({"roll_rate": place, "entries": len(here), **later, **gap, **misses})
        note = (
            f"How much later than the plan an aircraft of {AIRCRAFT.airspeed_m_s:g} m/s can join with the bank of the "
            "hold, median and extremes; gap: how much less time may be possible (rolling.md); missed: "
            "by how much the path misses when another integrator flies it."
        )
        return Findings(rows, note, all(bound.passed for bound in found))

    return compare


_METHODS: dict[str, Callable[[int, int, int], Callable[[], Findings]]] = {
    "search": _search,
    "digits": _digits,
    "collocation": _collocation,
    "reachability": _reachability,
    "wind": _wind,
    "rolling": _rolling,
}


def _by_place(found: Sequence[tuple[str, Any]]) -> Iterator[tuple[str, list[Any]]]:
    """The results of each place, and of all where there are several."""
    places = dict.fromkeys(place for place, _ in found)
    for place in places:
        yield place, [result for where, result in found if where == place]
    if len(places) > 1:
        yield "all", [result for _, result in found]
