"""A welded mesh as a 3MF package: mm, the object's name, and a picture of it."""

import io
import zipfile
from xml.sax.saxutils import escape, quoteattr

from relieffab.panel.model import Floats, Ints

# 3MF Core Specification 1.3: the package's parts and their relationships.
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL_TYPE = "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"
RELATIONS_TYPE = "application/vnd.openxmlformats-package.relationships+xml"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
MODEL, PICTURE = "3D/3dmodel.model", "Metadata/thumbnail.png"
CONTENT_TYPES = (
    f'{XML}<Types xmlns="{PACKAGE}/content-types">'
    f'<Default Extension="rels" ContentType="{RELATIONS_TYPE}"/>'
    f'<Default Extension="model" ContentType="{MODEL_TYPE}"/>'
    '<Default Extension="png" ContentType="image/png"/></Types>'
)
TO_MODEL = (
    f'<Relationship Id="model" Target="/{MODEL}" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
)
# Open Packaging Conventions, 6.2.6: one picture for the whole package.
TO_PICTURE = (
    f'<Relationship Id="thumbnail" Target="/{PICTURE}" '
    f'Type="{PACKAGE}/relationships/metadata/thumbnail"/>'
)


def _relations(*them: str) -> str:
    return f'{XML}<Relationships xmlns="{PACKAGE}/relationships">{"".join(them)}</Relationships>'


def _model_xml(vertices: Floats, faces: Ints, name: str) -> str:
    """Describe one object in mm, 3MF Core Specification, chapters 3 and 4."""
    vertex = '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n' * len(vertices)
    triangle = '<triangle v1="%d" v2="%d" v3="%d"/>\n' * len(faces)
    name = "".join(letter if letter.isprintable() else "?" for letter in name)
    return (
        f'{XML}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}">\n'
        f'<metadata name="Title">{escape(name)}</metadata>\n'
        '<metadata name="Application">relieffab</metadata>\n<resources>'
        f'<object id="1" type="model" name={quoteattr(name)}><mesh>\n<vertices>\n'
        f"{vertex % tuple(vertices.ravel().tolist())}</vertices>\n<triangles>\n"
        f"{triangle % tuple(faces.ravel().tolist())}</triangles>\n"
        '</mesh></object></resources>\n<build><item objectid="1"/></build>\n</model>\n'
    )


def to_3mf(vertices: Floats, faces: Ints, name: str, picture: bytes | None) -> bytes:
    """Pack a mesh into a 3MF file; the same input gives the same bytes.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm; nine digits hold single precision exactly.
    faces : (f, 3) ndarray of int
    name : str
        The object's, and the package's title.
    picture : bytes or None
        A PNG file, what a folder or a slicer shows of the package.
    """
    parts: dict[str, str | bytes] = {
        "[Content_Types].xml": CONTENT_TYPES,
        "_rels/.rels": _relations(TO_MODEL, *([TO_PICTURE] if picture else [])),
        MODEL: _model_xml(vertices, faces, name),
    }
    if picture:
        parts[PICTURE] = picture
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as package:
        for place, content in parts.items():
            # An entry made by hand carries 1980 as its date, not today's.
            entry = zipfile.ZipInfo(place)
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, content)
    return file.getvalue()
