"""Names of what a picture shows; `kind` tells them apart."""

PHOTO, DRAWING, DEPTH, NORMAL = KINDS = ("photo", "drawing", "depth", "normal")
DEPTH_FAR, NORMAL_DOWN = ("depth-white-far", "normal-y-down")
NAMES = (*KINDS, DEPTH_FAR, NORMAL_DOWN)
"""What a person may say; the last two settle what the values would."""
