"""The direction of strokes: along or around the form, smoothed, and parted by drawn lines."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse.linalg import spsolve

from relieffab.layers.model import Layers

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complexes = NDArray[np.complex128]

COARSE = 0.3  # mm: the field is found on cells about so wide
MOST = 500  # of them along the figure's longer side
CALM = (
    6.0  # mm over which directions that disagree are evened out: less left ladders on flat ground
)
FLATTEST = 0.02  # 1/mm: ground that bends less has no direction of its own
HABIT = 60.0, 0.01  # degrees, and weight: where the form says nothing, a right hand's stroke


class _Cells(NamedTuple):
    """The pixels in square blocks."""

    factor: int
    shape: tuple[int, int]

    @classmethod
    def of(cls, layers: Layers) -> "_Cells":
        rows, cols = layers.mask.shape
        factor = max(round(COARSE / layers.pitch), -(-max(rows, cols) // MOST), 1)
        return cls(factor, (-(-rows // factor), -(-cols // factor)))

    def sums(self, image: Floats) -> Floats:
        """Sum an image over each cell."""
        rows, cols = (n * self.factor for n in self.shape)
        wide = np.pad(image, ((0, rows - image.shape[0]), (0, cols - image.shape[1])))
        split = wide.reshape(self.shape[0], self.factor, self.shape[1], self.factor)
        return split.sum(axis=(1, 3))  # type: ignore[no-any-return]


def bending(layers: Layers, clear: Bools) -> tuple[Floats, Floats]:
    """Differentiate the normals across the panel, at pixels that are clear of lines.

    Returns
    -------
    weight : (rows, cols) ndarray
        1 where it is known, else 0.
    tensor : (3, rows, cols) ndarray
        Its symmetric part, 1/mm: xx, yy, and xy.
    """
    n, pitch = layers.normals[..., :2], layers.pitch
    known = clear & layers.mask
    whole = ndimage.binary_erosion(known, np.ones((3, 3)))
    along = (np.roll(n, -1, axis=1) - np.roll(n, 1, axis=1)) / (2 * pitch)
    up = (np.roll(n, 1, axis=0) - np.roll(n, -1, axis=0)) / (2 * pitch)
    tensor = np.stack([along[..., 0], up[..., 1], 0.5 * (along[..., 1] + up[..., 0])])
    return whole.astype(float), tensor * whole


def sharpest(tensor: Floats) -> Complexes:
    """Direction of the largest bending as a complex number of twice its angle.

    Its length is 1 on a cylinder, and falls to 0 on spheres, saddles and planes,
    where no direction is better than another.

    Parameters
    ----------
    tensor : (3, ...) ndarray
        xx, yy and xy, 1/mm.
    """
    xx, yy, xy = tensor
    apart, total = (xx - yy) + 2j * xy, xx + yy
    return 2 * apart * total / (np.abs(apart) ** 2 + total**2 + FLATTEST**2)  # type: ignore[no-any-return]


def _laplacian(open_: Bools) -> sparse.csr_matrix:
    """Graph Laplacian of the open cells, each joined to its four neighbours."""
    number = np.cumsum(open_.ravel()).reshape(open_.shape) - 1
    pairs = []
    for a, b in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        both = open_[a] & open_[b]
        pairs.append(np.stack([number[a][both], number[b][both]]))
    i, j = np.concatenate(pairs, axis=1)
    count = int(open_.sum())
    joined = sparse.coo_matrix((np.ones(2 * len(i)), (np.r_[i, j], np.r_[j, i])), (count, count))
    return sparse.csgraph.laplacian(joined.tocsr())


def smoothest(wanted: Complexes, open_: Bools, calm: float) -> Complexes:
    """Smooth directions where they are weak, and keep them where they are strong.

    Minimises sum |w| |u - w/|w||² + calm² |grad u|² over the open cells, as
    Knöppel, Crane, Pinkall and Schröder, "Globally optimal direction fields"
    (ACM Trans. Graph. 32, 2013) do on meshes, with a weak pull to the habit.

    Parameters
    ----------
    wanted : (n, m) ndarray of complex
        Directions of twice the angle; longer ones count for more.
    open_ : (n, m) ndarray of bool
        Cells that have a direction; others part them.
    calm : float
        Cells.

    Returns
    -------
    (n, m) ndarray of complex
        Of length 1; closed cells have their nearest open cell's.
    """
    angle, pull = HABIT
    habit = np.exp(2j * np.radians(angle))
    field = np.full(open_.shape, habit)
    if not open_.any():
        return field
    asked = wanted[open_]
    weight = sparse.diags(np.abs(asked) + pull)
    found = spsolve((weight + calm**2 * _laplacian(open_)).tocsc(), asked + pull * habit)
    length = np.abs(found)
    field[open_] = np.where(length > 1e-9, found / np.maximum(length, 1e-9), habit)
    nearest = ndimage.distance_transform_edt(~open_, return_distances=False, return_indices=True)
    return field[tuple(nearest)]


def form_field(layers: Layers, clear: Bools, *, around: bool) -> Complexes:
    """Directions that follow the form.

    Parameters
    ----------
    layers : Layers
    clear : (rows, cols) ndarray of bool
        Pixels that no line, wall or occlusion runs through: what they part
        does not even out.
    around : bool
        Around the form, where it bends most, as engravers hatch; else along it, where it
        bends least.

    Returns
    -------
    (rows + 1, cols + 1) ndarray of complex
        At nodes: exp(2i angle), the angle from X towards Y.
    """
    cells = _Cells.of(layers)
    weight, tensor = bending(layers, clear)
    seen = cells.sums(weight)
    mean = np.stack([cells.sums(part) for part in tensor]) / np.maximum(seen, 1.0)
    share = seen / cells.factor**2
    open_ = cells.sums((clear & layers.mask).astype(float)) > 0.5 * cells.factor**2
    wanted = np.where(open_, sharpest(mean) * share, 0.0)
    field = smoothest(wanted, open_, CALM / (cells.factor * layers.pitch))
    return _at_nodes(field if around else -field, cells.factor, layers.grid.node_shape)


def _at_nodes(field: Complexes, factor: int, shape: tuple[int, int]) -> Complexes:
    """Interpolate a field of cells at the nodes."""
    at = np.meshgrid(*((np.arange(n) / factor - 0.5) for n in shape), indexing="ij")
    parts = [
        ndimage.map_coordinates(p, at, order=1, mode="nearest") for p in (field.real, field.imag)
    ]
    joined: Complexes = parts[0] + 1j * parts[1]
    return joined / np.maximum(np.abs(joined), 1e-9)


def fixed_field(angle: float, shape: tuple[int, int]) -> Complexes:
    """One direction everywhere, in degrees from X towards Y, as `form_field` gives it."""
    return np.full(shape, np.exp(2j * np.radians(angle)))
