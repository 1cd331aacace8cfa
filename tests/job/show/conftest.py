import numpy as np
import pytest
import trimesh

from relieffab.job import run
from relieffab.job.settings import resolve


@pytest.fixture(scope="session")
def job(tmp_path_factory):
    """The folder of a whole job, small."""
    ball = trimesh.creation.icosphere(subdivisions=3)
    place = tmp_path_factory.mktemp("shown")
    model = place / "ball.obj"
    trimesh.Trimesh(np.array(ball.vertices) * [3, 2, 1.5], ball.faces).export(model)
    chosen = {"model": str(model), "size": "40x30mm", "resolution": "80x60", "depth": "1mm"}
    run.make(resolve([("flag", {**chosen, "margin": "3mm", "scallop": "0.05mm"})]), place / "job")
    return place / "job"
