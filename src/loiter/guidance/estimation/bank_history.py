"""The modelled bank over the last seconds, which old measurements do not show yet."""

from __future__ import annotations

from math import inf
from typing import Annotated, NamedTuple

# The history covers at least this time, seconds, in this many entries.
COVERED_S, ENTRIES = 2.0, 128


class BankEntry(NamedTuple):
    """The end of a step, the bank then, and the integral of the bank up to then: seconds and degrees."""

    end_s: float
    bank_deg: float
    integral: float


class BankHistory(NamedTuple):
    """The present bank, and the last steps in a ring of fixed length, oldest first; unused entries end at -inf.

    Between the ends of steps the bank is interpolated.
    """

    current_deg: float
    entries: Annotated[tuple[BankEntry, ...], ENTRIES]


def constant_history(bank_deg: float) -> BankHistory:
    """The history of a bank that has always been this."""
    unused = (BankEntry(-inf, bank_deg, 0.0),) * ENTRIES
    return BankHistory(bank_deg, (*unused[:-1], BankEntry(0.0, bank_deg, 0.0)))


def record_bank(history: BankHistory, bank_deg: float, dt: float, covered_s: float = COVERED_S) -> BankHistory:
    """The history with another step of `dt` seconds and the bank at its end; it covers at least `covered_s`.

    Once the ring is full, steps that are so short that it would not cover that time are joined: two entries that follow
    each other then last longer than twice that time divided by their number.
    """
    entries, dt = history.entries, min(dt, covered_s)
    last = entries[-1]
    entry = BankEntry(last.end_s + dt, bank_deg, last.integral + dt * 0.5 * (last.bank_deg + bank_deg))
    if entry.end_s - entries[-2].end_s > 2.0 * covered_s / ENTRIES or entries[0].end_s == -inf:
        return BankHistory(bank_deg, (*entries[1:], entry))
    return BankHistory(bank_deg, (*entries[:-1], entry))


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


def bank_within(history: BankHistory, index: int, time_s: float) -> float:
    """The bank at a time within an entry, between those at its ends; before the first entry it was constant."""
    entry = history.entries[index]
    if index == 0:
        return entry.bank_deg
    before = history.entries[index - 1]
    if before.end_s == -inf or entry.end_s <= before.end_s:
        return entry.bank_deg
    return entry.bank_deg - (entry.end_s - time_s) / (entry.end_s - before.end_s) * (entry.bank_deg - before.bank_deg)


def delayed_deg(history: BankHistory, delay_s: float) -> float:
    """The bank `delay_s` seconds ago."""
    if delay_s <= 0.0:
        return history.current_deg
    then_s = history.entries[-1].end_s - delay_s
    return bank_within(history, index_at(history, then_s), then_s)


def mean_deg(history: BankHistory, delay_s: float) -> float:
    """The mean bank over the last `delay_s` seconds."""
    if delay_s <= 0.0:
        return history.current_deg
    last = history.entries[-1]
    then_s = last.end_s - delay_s
    index = index_at(history, then_s)
    first, bank_deg = history.entries[index], bank_within(history, index, then_s)
    return (last.integral - first.integral + (first.end_s - then_s) * 0.5 * (bank_deg + first.bank_deg)) / delay_s
