"""The answers of the service, as JSON values and files."""
