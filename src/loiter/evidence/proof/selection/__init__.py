"""Theorem 2 of docs/proof.md: which words the kernel compares, checked for every combination of signs."""
