"""What a Dask worker loads to work slowly: `--preload tables.slow`."""

import time

from loiter.tables import parts

_solve_batch = parts.solve_batch


def _slowly(*arguments):
    time.sleep(0.05)
    return _solve_batch(*arguments)


parts.solve_batch = _slowly
