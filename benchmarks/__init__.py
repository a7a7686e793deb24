"""Costs of the answers, compared with other ways to compute them. `make bench` runs all benchmarks."""
