"""From a 3D model to a carved sunken relief."""

__version__ = "0.1.0"
