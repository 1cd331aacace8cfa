"""A mesh in fewer triangles, to be looked at."""

from dataclasses import replace

import numpy as np

from relieffab.layers.mesh import Mesh

HASTE = (2, 3, 5, 7)
"""How fast the bound on the error grows, tried in turn: slowly leaves even triangles, from which
the same lines are drawn, but may end before there are few enough."""
MORE = 1.2
"""Times the triangles asked for that will do."""


def coarser(mesh: Mesh, most: int) -> Mesh:
    """Give a mesh that has no more than so many triangles, about the same to look at.

    By quadric error (Garland and Heckbert, Surface simplification using quadric error
    metrics, 1997), without a bound: nothing that is cut is made from it.

    Parameters
    ----------
    mesh : Mesh
    most : int
        Triangles.

    Returns
    -------
    Mesh
        The mesh itself where it has no more; else a fifth more than asked for, at most.
    """
    if len(mesh.faces) <= most:
        return mesh
    import trimesh

    # The library takes no arrays that are read-only.
    whole = trimesh.Trimesh(mesh.vertices.copy(), mesh.faces.copy(), process=False)
    for haste in HASTE:
        fewer = whole.simplify_quadric_decimation(face_count=most, aggression=haste)
        if len(fewer.faces) <= MORE * most:
            break
    return replace(
        mesh,
        vertices=np.array(fewer.vertices, np.float64),
        faces=np.array(fewer.faces, np.int64),
    )
