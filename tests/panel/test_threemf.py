import io
import zipfile

import numpy as np
import pytest
import trimesh
from lxml import etree
from PIL import Image

from relieffab.panel.threemf import to_3mf

RELATION = "{http://schemas.openxmlformats.org/package/2006/relationships}Relationship"


@pytest.fixture
def box():
    mesh = trimesh.creation.box((1, 2, 3))
    return np.array(mesh.vertices), np.array(mesh.faces)


def a_png():
    file = io.BytesIO()
    Image.new("RGB", (4, 3), "teal").save(file, format="PNG")
    return file.getvalue()


def opened(data):
    return zipfile.ZipFile(io.BytesIO(data))


def targets(package):
    relations = etree.fromstring(package.read("_rels/.rels")).iter(RELATION)
    return {one.get("Type").rpartition("/")[2]: one.get("Target") for one in relations}


def test_the_package_shows_its_picture(box):
    with opened(to_3mf(*box, "box", a_png())) as package:
        assert package.namelist()[0] == "[Content_Types].xml"
        assert targets(package) == {
            "3dmodel": "/3D/3dmodel.model",
            "thumbnail": "/Metadata/thumbnail.png",
        }
        picture = Image.open(package.open("Metadata/thumbnail.png"))
        assert (picture.size, picture.getpixel((1, 1))) == ((4, 3), (0, 128, 128))
        types = package.read("[Content_Types].xml")
        assert {one.get("Extension") for one in etree.fromstring(types)} == {"rels", "model", "png"}


def test_without_a_picture_there_is_no_relation_to_one(box):
    with opened(to_3mf(*box, "box", None)) as package:
        assert set(targets(package)) == {"3dmodel"}
        assert "Metadata/thumbnail.png" not in package.namelist()


def test_names_that_xml_cannot_hold_do_not_break_it(box):
    with opened(to_3mf(*box, "a\x01\udcff<b>", None)) as package:
        model = etree.fromstring(package.read("3D/3dmodel.model"))
    assert model.find(".//{*}object").get("name") == "a??<b>"
    assert model.find("{*}metadata[@name='Title']").text == "a??<b>"
    assert model.get("unit") == "millimeter"
