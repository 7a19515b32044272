"""What a test of a step would show: modes, their motion along the axis, and what supports and sensors do to them."""
