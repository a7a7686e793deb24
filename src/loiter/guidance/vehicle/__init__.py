"""What laws and simulators assume of an aircraft: turn rates, bank limits and roll response."""
