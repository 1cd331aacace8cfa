"""A studio with a small model, served without a network."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from starlette.testclient import TestClient

from relieffab.job.settings import default_job, resolve
from relieffab.layers.image.read import read_picture
from relieffab.studio.app import make_app
from relieffab.studio.desk import Desk
from relieffab.studio.guard import Guard
from relieffab.studio.model import lightened
from relieffab.studio.sheet import sheet_of_picture

TOKEN, PORT = "a-token-nobody-guesses", 8765
SMALL = {
    "size": "40x30mm",
    "margin": "3mm",
    "depth": "1.5mm",
    "resolution": "96x72",
    "scallop": "0.05mm",
}


@pytest.fixture(scope="session")
def ball(tmp_path_factory):
    """A bumpy ball in a file."""
    sphere = trimesh.creation.icosphere(subdivisions=4)
    v = np.array(sphere.vertices) * [3, 2, 1.5]
    v *= 1 + 0.05 * np.sin(5 * v[:, :1]) * np.sin(4 * v[:, 1:2])
    path = tmp_path_factory.mktemp("model") / "ball.obj"
    trimesh.Trimesh(v, sphere.faces, process=False).export(path)
    return path


@pytest.fixture(scope="session")
def opened(model):
    """The bumpy ellipsoid as a studio has it."""
    return lightened(model, Path("bumps.obj"))


@pytest.fixture(scope="session")
def bump(tmp_path_factory):
    """The depth map of a bumpy dome, of 16 bits."""
    i, j = np.indices((90, 120)) - np.array([44.5, 59.5])[:, None, None]
    height = 1 - (i / 40) ** 2 - (j / 52) ** 2 + 0.1 * np.sin(i / 4) * np.sin(j / 5)
    grey = np.where(height > 0, 4000 + 50000 * np.maximum(height, 0), 0)
    path = tmp_path_factory.mktemp("picture") / "bump.png"
    Image.fromarray(grey.astype(np.uint16)).save(path)
    return path


@pytest.fixture(scope="session")
def picture(bump):
    """That map as a studio has it."""
    return sheet_of_picture(read_picture(bump), bump)


@pytest.fixture(scope="session")
def job():
    """A job on a small panel, as typed settings change it."""

    def make(**typed):
        return replace(default_job(**{**SMALL, **typed}), model="bumps.obj", up="y")

    return make


@pytest.fixture
def desk(tmp_path):
    """A desk with nothing on it."""
    desk = Desk(resolve([("test", SMALL)]), tmp_path / "jobs")
    yield desk
    desk.close()


@pytest.fixture
def client(desk):
    """The page's side."""
    app = Guard(make_app(desk), token=TOKEN, port=PORT)
    with TestClient(app, base_url=f"http://127.0.0.1:{PORT}/{TOKEN}") as client:
        yield client
