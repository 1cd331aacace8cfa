"""A winged scarab raising the sun, after the jewels of the New Kingdom."""

from relieffab.subject.beetle import draw_beetle
from relieffab.subject.canvas import Canvas, Mesh
from relieffab.subject.sdf import Field, Point, common, cone, disc, ellipsoid, torus, union
from relieffab.subject.wing import draw_wing

SIZE = (116.0, 86.0, 18.0)
SUN = (0.0, 30.2)


def _sun(p: Point) -> Field:
    """Shape the sun: a dome on a plate, within a raised rim."""
    plate = common(disc(p, SUN, 9.8), p.z - 6.2)
    dome = ellipsoid(p, (*SUN, 3.0), (8.3, 8.3, 7.2))
    return union(union(plate, dome, 0.9), torus(p, (*SUN, 6.6), 9.7, 1.2), 0.4)


def _ring(p: Point) -> Field:
    """Shape the shen, a coil of rope on its bar: all that the sun goes round."""
    ring = torus(p, (0.0, -34.6, 5.6), 4.3, 1.2)
    pearl = ellipsoid(p, (0.0, -34.6, 3.0), (2.3, 2.3, 4.2))
    bar = cone(p, (-7.6, -39.6, 5.6), (7.6, -39.6, 5.6), (1.2, 1.2))
    plate = common(disc(p, (0.0, -34.6), 4.3), p.z - 4.8)
    return union(union(union(plate, ring), pearl), bar)


def scarab(*, cell: float = 0.28) -> Mesh:
    """Model a winged scarab that holds the sun disc between its forelegs.

    Parameters
    ----------
    cell : float
        Side of the grid cells it is meshed from, mm; detail is about 0.7 mm wide.

    Returns
    -------
    vertices : (v, 3) ndarray
        mm; X right, Y up, Z to the viewer, the flat back on Z = 0; some
        113 x 82 x 14 mm, centred on X = Y = 0.
    faces : (f, 3) ndarray of int64
        Counter-clockwise seen from outside; one closed body.
    """
    canvas = Canvas(SIZE, cell)
    draw_wing(canvas)
    canvas.draw(_sun, (0, 18, 0), (12, 42, 11))
    canvas.draw(_ring, (0, -42, 0), (9, -28, 8))
    draw_beetle(canvas)
    return canvas.mesh()
