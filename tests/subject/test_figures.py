"""Cat, falcon and lotus: whole, of their size, standing as they are seen."""

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.mesh import make_mesh
from relieffab.subject import cat, falcon, lotus


@pytest.mark.parametrize(
    ("figure", "size"),
    [(cat, (62, 104, 24)), (falcon, (62, 101, 24)), (lotus, (92, 97, 18))],
    ids=["cat", "falcon", "lotus"],
)
def test_a_figure_is_one_closed_surface_of_its_size(figure, size):
    vertices, faces = figure(cell=0.8)
    assert np.ptp(vertices, axis=0) == pytest.approx(size, abs=2.5)
    assert vertices[:, 2].min() == pytest.approx(0, abs=0.01)
    mesh = make_mesh(vertices, faces)
    assert mesh.notes == ()
    corners = vertices[faces]
    volume = np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume > 10_000


def test_the_lotus_is_symmetrical_and_the_cat_is_not():
    flower, _ = lotus(cell=0.8)
    assert flower[:, 0].min() == pytest.approx(-flower[:, 0].max())
    head = cat(cell=0.8)[0]
    head = head[(head[:, 1] > 28) & (head[:, 1] < 34)]
    # It looks to the right: its muzzle is further from the neck than the nape is.
    assert head[:, 0].max() - 7.5 > 7.5 - head[:, 0].min()


def test_a_cell_must_fit():
    with pytest.raises(InputError, match="cell is out of range"):
        cat(cell=0.0)
