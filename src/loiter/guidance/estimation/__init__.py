"""What the law knows of its aircraft and its state: clock, observer, and the identification of the vehicle."""
