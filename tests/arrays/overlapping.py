"""Where the result of a ufunc lies in the memory of one of its arguments."""


def overlaps(count):
    """Slices of an array for an argument and for the result: reversed, one further, one back, every third, the same.

    For every third, `count` results lie in the memory of an array of three times that length.
    """
    return {
        "reversed": (slice(None, None, -1), slice(None)),
        "further": (slice(None, -1), slice(1, None)),
        "back": (slice(1, None), slice(None, -1)),
        "every third": (slice(0, count), slice(0, 3 * count, 3)),
        "same": (slice(None), slice(None)),
    }
