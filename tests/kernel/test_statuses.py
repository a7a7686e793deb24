"""Statuses."""

import pytest

from loiter.kernel.statuses import Status


@pytest.mark.parametrize("status", Status)
def test_every_status_has_a_sentence_of_its_own(status):
    assert status.message
    assert len({other.message for other in Status}) == len(Status)
