"""What is particular to ArduPlane and to PX4: modes, parameters, fitness to be guided, setpoints for a bank."""
