"""Edges of triangles, told apart by one number each; and how triangles lie in plan."""

import numpy as np

from relieffab.panel.model import Floats, Ints


def edge_keys(faces: Ints, *, reverse: bool = False) -> Ints:
    """Give one number to each directed edge of each triangle, (3 f,)."""
    start, end = faces, np.roll(faces, -1, axis=1)
    span = int(faces.max(initial=0)) + 1
    return (end * span + start if reverse else start * span + end).ravel()


def has_repeats(keys: Ints) -> bool:
    """Say whether any number occurs twice (by sorting: np.unique hashes, 70 times slower)."""
    ordered = np.sort(keys)
    return bool((ordered[1:] == ordered[:-1]).any())


def outline(faces: Ints) -> Ints:
    """Directed edges with a triangle on their left only, (n, 2)."""
    there, back = edge_keys(faces), edge_keys(faces, reverse=True)
    either = np.minimum(there, back)
    order = np.argsort(either)
    fresh = np.diff(either[order], prepend=-1) != 0
    alone = there[order[fresh & np.append(fresh[1:], True)[: len(fresh)]]]
    return np.stack(np.divmod(alone, int(faces.max(initial=0)) + 1), axis=1)


def plan_areas(vertices: Floats, faces: Ints) -> Floats:
    """Give twice the area of each triangle seen along its third axis, (f,).

    More than 0 where it turns from the first axis to the second.
    """
    a, b, c = (vertices[faces[:, k], :2] for k in range(3))
    u, v = b - a, c - a
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]  # type: ignore[no-any-return]
