"""Independent verification methods, and the checks that compare the kernel's answers with their results."""
