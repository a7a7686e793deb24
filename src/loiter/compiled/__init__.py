"""The kernel's functions as machine code, built from C that is generated from them; otherwise in plain Python.

The modules `single` and `loops` are built with the package from src/loiter/native. A package without them runs the same
functions in plain Python.
"""
