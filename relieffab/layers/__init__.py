"""Three aligned images of one model from one view: lines, shading, depth."""
