"""The modelled bank over the last seconds, which old measurements do not show yet."""

from __future__ import annotations

from math import inf
from typing import Annotated, NamedTuple

# The history covers at least this time, seconds, in this many entries.
COVERED_S, ENTRIES = 2.0, 128


class BankEntry(NamedTuple):
    """The end of a step, the bank during it, and the integral of the bank up to its end: seconds and degrees."""

    end_s: float
    bank_deg: float
    integral: float


class BankHistory(NamedTuple):
    """The present bank, and the last steps in a ring of fixed length, oldest first; unused entries end at -inf."""

    current_deg: float
    entries: Annotated[tuple[BankEntry, ...], ENTRIES]


def constant_history(bank_deg: float) -> BankHistory:
    """The history of a bank that has always been this."""
    unused = (BankEntry(-inf, bank_deg, 0.0),) * ENTRIES
    return BankHistory(bank_deg, (*unused[:-1], BankEntry(0.0, bank_deg, 0.0)))


def recorded(history: BankHistory, bank_deg: float, dt: float, covered_s: float = COVERED_S) -> BankHistory:
    """The history with another step of `dt` seconds and the bank at its end; it covers at least `covered_s`.

    Once the ring is full, steps that are so short that it would not cover that time are joined: two entries that follow
    each other then last longer than twice that time divided by their number. An entry of joined steps has their mean
    bank.
    """
    entries, dt = history.entries, min(dt, covered_s)
    before, last = entries[-2], entries[-1]
    end_s, integral = last.end_s + dt, last.integral + dt * bank_deg
    if end_s - before.end_s > 2.0 * covered_s / ENTRIES or entries[0].end_s == -inf:
        return BankHistory(bank_deg, (*entries[1:], BankEntry(end_s, bank_deg, integral)))
    mean_deg = (integral - before.integral) / (end_s - before.end_s)
    return BankHistory(bank_deg, (*entries[:-1], BankEntry(end_s, mean_deg, integral)))


def index_at(history: BankHistory, time_s: float) -> int:
    """The index of the first entry that ends at a time or later."""
    entries, low, high = history.entries, 0, ENTRIES - 1
    while low < high:
        middle = (low + high) >> 1
        if entries[middle].end_s < time_s:
            low = middle + 1
        else:
            high = middle
    return low


def delayed_deg(history: BankHistory, delay_s: float) -> float:
    """The bank `delay_s` seconds ago."""
    if delay_s <= 0.0:
        return history.current_deg
    entries = history.entries
    return entries[index_at(history, entries[-1].end_s - delay_s)].bank_deg


def mean_deg(history: BankHistory, delay_s: float) -> float:
    """The mean bank over the last `delay_s` seconds."""
    if delay_s <= 0.0:
        return history.current_deg
    entries = history.entries
    last, then_s = entries[-1], entries[-1].end_s - delay_s
    first = entries[index_at(history, then_s)]
    return (last.integral - first.integral + (first.end_s - then_s) * first.bank_deg) / delay_s
