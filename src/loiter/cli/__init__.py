"""The command line: it parses options, calls the library and prints; it contains no mathematics."""
