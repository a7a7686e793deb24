"""What answers cost, beside the same work done otherwise. `make bench` runs all of it."""
