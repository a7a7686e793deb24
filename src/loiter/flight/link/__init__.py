"""A MAVLink connection: the link, commands, parameters, message streams."""
