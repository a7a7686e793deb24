"""Batch jobs: divided into parts, solved by threads or a Dask cluster, resumed after an interruption."""
