from pathlib import Path

import numpy as np

from relieffab.studio import model as studio_model
from relieffab.studio.model import lightened, load, save


def test_a_model_comes_back_as_it_was_saved(model, tmp_path, monkeypatch):
    monkeypatch.setattr(studio_model, "TRIED", 1000)
    made = lightened(model, Path("bumps.obj"))
    save(made, tmp_path)
    back = load(tmp_path, Path("elsewhere/bumps.obj"))
    assert (back.triangles, back.up, back.name) == (len(model.faces), made.up, "bumps.obj")
    assert len(back.shown.faces) == len(model.faces)
    assert len(back.tried.faces) <= 1200
    for one, other in ((made.shown, back.shown), (made.tried, back.tried)):
        np.testing.assert_array_equal(one.vertices, other.vertices)
        np.testing.assert_array_equal(one.faces, other.faces)
        assert (one.notes, one.usual_up) == (other.notes, other.usual_up)
