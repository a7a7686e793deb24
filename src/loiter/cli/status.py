"""Exit statuses of the program."""

CHECK_FAILED = 1
USAGE_ERROR = 2
LINK_FAILED = 3
INTERRUPTED = 130  # 128 + SIGINT, as shells report it
