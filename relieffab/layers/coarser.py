"""A mesh in fewer triangles, to be looked at."""

from dataclasses import replace

import numpy as np

from relieffab.layers.mesh import Mesh


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
        The mesh itself where it has no more.
    """
    if len(mesh.faces) <= most:
        return mesh
    import trimesh

    # The library takes no arrays that are read-only.
    whole = trimesh.Trimesh(mesh.vertices.copy(), mesh.faces.copy(), process=False)
    fewer = whole.simplify_quadric_decimation(face_count=most)
    return replace(
        mesh,
        vertices=np.array(fewer.vertices, np.float64),
        faces=np.array(fewer.faces, np.int64),
    )
