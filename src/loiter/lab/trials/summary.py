"""Summaries of campaigns: the results of each law over all its flights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

import numpy as np

from loiter.lab.trials.campaign import Outcome

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


@dataclass(frozen=True)
class CampaignSummary:
    """The flights of one law. Ratios and delays compare settling times with the durations of the fastest entries.

    Medians and percentiles count a flight that did not settle as later than all others. `round_again` is the number of
    go-arounds. `sooner` is the share of the starts from which the law settled sooner than another law; nan where there
    is none to compare with.
    """

    flights: int
    settled: int
    round_again: int
    median_ratio: float
    ninth_decile_ratio: float
    median_late_s: float
    percentile_99_late_s: float
    median_overshoot_m: float
    bank_rate_deg_s: float
    worst_join_error_s: float
    sooner: float


def summary(outcomes: Sequence[Outcome], others: Sequence[Outcome] = ()) -> CampaignSummary:
    """The summary of one law, compared with the flights `others` of another law from the same starts, if given."""
    ideal_s = np.array([o.ideal_s for o in outcomes])
    settled_s = _later_than_all([o.settled_s for o in outcomes])
    # A start on the circle has no ratio: the fastest entry takes no time.
    off_circle = ideal_s > 0.0
    ratio, late_s = settled_s[off_circle] / ideal_s[off_circle], settled_s - ideal_s
    sooner = np.mean(settled_s < _later_than_all([o.settled_s for o in others])) if others else np.nan
    return CampaignSummary(
        len(outcomes),
        sum(o.settled for o in outcomes),
        sum(o.round_again for o in outcomes),
        _quantile(ratio, 0.5),
        _quantile(ratio, 0.9),
        _quantile(late_s, 0.5),
        _quantile(late_s, 0.99),
        float(np.median([o.overshoot_m for o in outcomes])),
        float(np.mean([o.bank_rate_deg_s for o in outcomes])),
        float(np.max([o.join_error_s for o in outcomes])),
        float(sooner),
    )


def _later_than_all(times_s: Sequence[float]) -> NDArray[float64]:
    """Settling times as an array, infinite in place of nan."""
    times = np.array(times_s, dtype=float)
    return np.where(np.isnan(times), np.inf, times)


def _quantile(values: NDArray[float64], share: float) -> float:
    """The quantile without interpolation, so that it can be infinite; nan of no values."""
    return float(np.sort(values)[int(np.ceil(share * values.size)) - 1]) if values.size else nan
