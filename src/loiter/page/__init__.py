"""The page, which shows the plan while the user drags the aircraft.

`source` is its JavaScript and HTML, `answers` the Python that is translated for it. `python -m codegen` makes `built`
of them, which is all that a package has of the page, and which `server` serves.
"""
