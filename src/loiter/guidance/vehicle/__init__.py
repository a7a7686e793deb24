"""The model of the aircraft that laws and simulators share: turn rates, bank limits and roll response."""
