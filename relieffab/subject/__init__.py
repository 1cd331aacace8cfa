"""The toolkit's own subjects, modelled in code: a first job needs no file."""

from relieffab.subject.pectoral import scarab

__all__ = ["scarab"]
