import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.image.figure import find_figure
from relieffab.layers.image.fit import fit_on
from relieffab.layers.image.maps import Laid, form_of_depth, form_of_normals


def laid(picture, stone):
    mask, source = find_figure(picture, even=True)
    fit = fit_on(mask, stone.grid, (40.0, 30.0), margin=3.0)
    return Laid(picture, mask, source, fit, fit.mask(mask))


def apart(one, other, there):
    """Largest angle between normals, but for the one in a hundred on the rim; degrees."""
    cosine = np.clip((one * other).sum(axis=2)[there], -1, 1)
    return np.degrees(np.percentile(np.arccos(cosine), 99))


def test_both_maps_of_a_stone_show_its_own_form(stone, depth_map, normal_map):
    picture, deep = depth_map(stone, None)
    depth, turned = form_of_depth(laid(picture, stone), facts := {}, deep=deep)
    np.testing.assert_allclose(depth[stone.mask], stone.depth[stone.mask], atol=1e-3)
    assert facts["depth_mm"] == pytest.approx(deep)
    assert (facts["near"], facts["near_by"]) == ("white", "background")
    _, normals = form_of_normals(laid(normal_map(stone, None), stone), facts)
    assert apart(normals, stone.normals, stone.mask) < 0.01
    assert apart(turned, stone.normals, stone.mask) < 20


def test_a_setting_goes_before_what_a_map_tells(stone, depth_map, normal_map):
    picture, deep = depth_map(stone, None)
    depth, _ = form_of_depth(laid(picture, stone), facts := {}, far=True, deep=deep)
    assert np.corrcoef(depth[stone.mask], stone.depth[stone.mask])[0, 1] < -0.999
    _, normals = form_of_normals(laid(normal_map(stone, None), stone), facts, down=True)
    assert apart(normals * [1.0, -1.0, 1.0], stone.normals, stone.mask) < 0.01
    assert facts["near_by"] == facts["green_by"] == "setting"


def test_what_is_no_map_of_the_kind_is_refused(stone, make_picture):
    with pytest.raises(InputError, match="three channels"):
        form_of_normals(laid(make_picture(stone.shading[0]), stone), {})
    with pytest.raises(InputError, match="turn away"):
        form_of_normals(laid(make_picture(1 - (stone.normals + 1) / 2), stone), {})
    with pytest.raises(InputError, match="level"):
        form_of_depth(laid(make_picture(0.5 * stone.mask), stone), {})
