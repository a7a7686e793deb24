"""Evidence for the kernel: independent methods that share no code with it, and checks of its formulas by machine."""
