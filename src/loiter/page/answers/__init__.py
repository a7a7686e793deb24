"""What the page computes of a scene: Python that is translated to JavaScript."""
