"""Evidence for the kernel: independent methods that share no code with it, and machine checks of the proof."""
