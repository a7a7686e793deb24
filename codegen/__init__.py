"""C99 from the kernel's Python: `make generate` writes src/loiter/native/*.h from src/loiter/kernel.

The kernel is written in a small subset of Python: numbers, named tuples, tuples of fixed length, branches and bounded
loops, functions without side effects and without recursion. Types come from the annotations of functions and of named
tuples. Whatever else occurs is refused in one sentence, with its place.
"""
