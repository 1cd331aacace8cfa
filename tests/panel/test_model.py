import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.panel.model import Panel


def test_arrays_cannot_be_changed():
    panel = Panel(np.zeros((3, 3)), np.zeros((1, 3), np.int64), False, 0.0, 0.0)
    with pytest.raises(ValueError, match="read-only"):
        panel.vertices[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        panel.faces[0, 0] = 1


def test_quads_are_refused():
    with pytest.raises(InputError, match=r"faces of shape \(n, 3\)"):
        Panel(np.zeros((4, 3)), np.zeros((1, 4), np.int64), False, 0.0, 0.0)
