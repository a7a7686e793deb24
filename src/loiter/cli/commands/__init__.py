"""The commands, one module each; `mavlink` has both `upload` and `watch`."""
