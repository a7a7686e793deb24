"""The answers of the service, as plain values."""
