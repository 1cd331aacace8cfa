"""The toolkit's own subjects, modelled in code: a first job needs no file."""

from relieffab.subject.cat import cat
from relieffab.subject.falcon import falcon
from relieffab.subject.lotus import lotus
from relieffab.subject.pectoral import scarab

__all__ = ["cat", "falcon", "lotus", "scarab"]
