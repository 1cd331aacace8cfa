"""Presentation pictures of reliefs and panels, and their encoding."""

from relieffab.picture.panel import panel_picture, solid_picture
from relieffab.picture.png import png8, png16, smaller
from relieffab.picture.render import OpenGLMissingError
from relieffab.picture.stone import hillshade, relit

__all__ = [
    "OpenGLMissingError",
    "hillshade",
    "panel_picture",
    "png8",
    "png16",
    "relit",
    "smaller",
    "solid_picture",
]
