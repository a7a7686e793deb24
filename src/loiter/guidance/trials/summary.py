"""What a campaign says about each law."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

from loiter.guidance.trials.campaign import Outcome

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Summary:
    """The flights of one law. Ratios and lateness are of the times to settle to the fastest entries'.

    Medians and percentiles count a flight that did not settle as later than all others. `sooner`: the share of the
    starts from which the law settled sooner than another; nan where there is none to compare with.
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


def summary(outcomes: Sequence[Outcome], others: Sequence[Outcome] = ()) -> Summary:
    """One law's flights, beside another law's from the same starts where there are any."""
    import numpy as np

    ideal_s = np.array([o.ideal_s for o in outcomes])
    settled_s = _later_than_all([o.settled_s for o in outcomes])
    # A start on the circle has nothing to be compared with.
    begun = ideal_s > 0.0
    ratio, late_s = settled_s[begun] / ideal_s[begun], settled_s - ideal_s
    sooner = np.mean(settled_s < _later_than_all([o.settled_s for o in others])) if others else np.nan
    return Summary(
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
    import numpy as np

    times = np.array(times_s, dtype=float)
    return np.where(np.isnan(times), np.inf, times)


def _quantile(values: NDArray[float64], share: float) -> float:
    """The value that this share of all does not exceed; unlike an interpolation it may be infinite."""
    import numpy as np

    return float(np.sort(values)[int(np.ceil(share * values.size)) - 1]) if values.size else nan
