"""SI: what a person says about an aircraft and its circle, and the maneuver that comes back."""
