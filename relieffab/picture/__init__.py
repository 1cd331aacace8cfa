"""Presentation pictures of reliefs and panels, and their encoding."""

from relieffab.picture.deviation import deviation_map
from relieffab.picture.look import predicted_look
from relieffab.picture.panel import panel_picture, solid_picture
from relieffab.picture.png import png8, png16, png_small, smaller
from relieffab.picture.render import OpenGLMissingError
from relieffab.picture.standing import standing_picture
from relieffab.picture.stone import hillshade, relit

__all__ = [
    "OpenGLMissingError",
    "deviation_map",
    "hillshade",
    "panel_picture",
    "png8",
    "png16",
    "png_small",
    "predicted_look",
    "relit",
    "smaller",
    "solid_picture",
    "standing_picture",
]
