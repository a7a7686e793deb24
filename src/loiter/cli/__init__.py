"""The command line: parses, calls the library, prints. No mathematics of its own."""
