"""What a Dask worker loads to work slowly: `--preload batch.slow`."""

import time

from loiter.batch.jobs import parts

_answered = parts.answered


def _slowly(*arguments):
    time.sleep(0.05)
    return _answered(*arguments)


parts.answered = _slowly
