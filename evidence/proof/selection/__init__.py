"""Theorem 2 of proof.md: which words the kernel compares, checked for every combination of signs."""
