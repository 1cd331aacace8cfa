import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.layers.shading import lambert
from relieffab.relief.descend import descend
from relieffab.relief.energy.couplings import levels
from relieffab.relief.energy.linearise import linearise
from relieffab.relief.fit import fit
from relieffab.relief.make import make_relief
from relieffab.relief.model import Relief, to_nodes
from relieffab.relief.multigrid.conjugate import solve
from relieffab.relief.solve import refitted
from relieffab.relief.targets import Carving, Fit, terms_of


@pytest.fixture(scope="module")
def carved(layers):
    return make_relief(layers, Carving(depth=1.5))


def bounded(layers):
    low = np.full(layers.grid.node_shape, -1.5, np.float32)
    return terms_of(layers, Carving(depth=1.5), Fit((-1.4, -0.3), 1.0), (low, 0.0))


def shading_of(relief, lights):
    h, pitch = relief.heights, relief.grid.pitch
    p = (h[:-1, 1:] + h[1:, 1:] - h[:-1, :-1] - h[1:, :-1]) / (2 * pitch)
    q = (h[:-1, :-1] + h[:-1, 1:] - h[1:, :-1] - h[1:, 1:]) / (2 * pitch)
    normals = np.stack([-p, -q, np.ones_like(p)], axis=2)
    return lambert(normals / np.linalg.norm(normals, axis=2, keepdims=True), lights)


def contrast(relief, layers):
    """How strongly the model's fine shading shows in the relief's: 1 is undiminished."""
    from scipy.ndimage import binary_erosion, gaussian_filter

    inside = binary_erosion(layers.mask, iterations=8)
    gains = []
    for a, b in zip(shading_of(relief, layers.lights), layers.shading, strict=True):
        x, y = ((s - gaussian_filter(s, 4))[inside] for s in (a, b))
        gains.append((x @ y) / (y @ y))
    return np.mean(gains)


def test_bounds_hold_exactly_and_the_top_is_on_the_face(carved, layers):
    relief, _ = carved
    figure = to_nodes(layers.mask.astype(float), np.ones(layers.grid.shape)) > 0
    assert relief.heights.min() >= -1.5
    assert relief.heights.max() == 0
    assert (relief.heights[~figure] == 0).all()
    assert relief.heights.min() < -1.0


def test_detail_is_kept_where_linear_compression_loses_it(carved, layers):
    relief, _ = carved
    seen = layers.depth[layers.mask]
    linear = np.where(layers.mask, (layers.depth - seen.max()) / np.ptp(seen) * 1.5, 0)
    plain = Relief(layers.grid, to_nodes(linear, layers.mask.astype(float)), layers.mask, 1.5)
    assert contrast(relief, layers) > 0.5
    assert contrast(relief, layers) > 2 * contrast(plain, layers)


def test_the_energy_is_at_its_minimum_within_the_bounds(layers):
    terms = bounded(layers)
    h, solution = descend(
        terms, np.clip(terms.form.astype(float), -1.5, 0), tolerance=1e-4, most=40
    )
    assert solution.residual <= 1e-4
    here = linearise(terms, h).value
    rng = np.random.default_rng(0)
    for _ in range(5):
        step = 1e-3 * rng.normal(size=h.shape) * (terms.figure)
        assert linearise(terms, np.clip(h + step, -1.5, 0)).value > here


def test_another_first_guess_gives_the_same_relief(layers):
    terms = bounded(layers)
    figure = terms.figure
    guesses = np.clip(terms.form.astype(float), -1.5, 0), np.where(figure, -0.7, 0.0)
    a, b = (descend(terms, g, tolerance=1e-6, most=60)[0] for g in guesses)
    assert np.abs(a - b).max() < 0.01 * 1.5


def test_twice_the_resolution_gives_the_same_relief(carved, finer_layers):
    from scipy.ndimage import binary_erosion

    fine, _ = make_relief(finer_layers, Carving(depth=1.5))
    coarse, _ = carved
    inside = binary_erosion(coarse.mask, iterations=6)
    nodes = inside[:-1, :-1] & inside[1:, 1:]
    a, b = coarse.heights[1:-1, 1:-1][nodes], fine.heights[::2, ::2][1:-1, 1:-1][nodes]
    assert np.sqrt(np.mean((a - b) ** 2)) < 0.02 * 1.5


def test_a_line_is_carved_where_it_is_drawn(layers, carved):
    lines = np.zeros(layers.grid.shape)
    lines[:, 79:81] = 1.0
    drawn = Layers(**{**vars(layers), "lines": lines})
    relief, _ = make_relief(drawn, Carving(depth=1.5, line_depth=0.3))
    from scipy.ndimage import binary_erosion

    rows = binary_erosion(layers.mask, iterations=8)[:, 80]
    here = relief.heights[:-1][rows]
    groove = here[:, 80] - (here[:, 74] + here[:, 86]) / 2
    plain = carved[0].heights[:-1][rows]
    before = plain[:, 80] - (plain[:, 74] + plain[:, 86]) / 2
    assert np.median(groove - before) < -0.15


def test_a_figure_that_touches_the_border_is_carved(layers):
    cut = Layers(
        grid=Grid(60, 80, layers.pitch, layers.grid.origin),
        depth=layers.depth[30:90, 40:120],
        normals=layers.normals[30:90, 40:120],
        mask=layers.mask[30:90, 40:120],
        lights=layers.lights,
        shading=layers.shading[:, 30:90, 40:120],
        lines=layers.lines[30:90, 40:120],
    )
    assert cut.mask.all()
    relief, _ = make_relief(cut, Carving(depth=1.5))
    assert relief.heights.min() < -0.5


def test_a_figure_of_a_few_pixels_is_carved(layers):
    mask = np.zeros(layers.grid.shape, bool)
    mask[60:63, 80:82] = True
    speck = Layers(**{**vars(layers), "mask": mask, "depth": layers.depth * mask})
    relief, _ = make_relief(speck, Carving(depth=1.5))
    assert np.isfinite(relief.heights).all()


def test_progress_is_told_and_can_cancel(layers):
    told = []
    make_relief(layers, Carving(depth=1.5), progress=lambda *a: told.append(a))
    assert told

    def cancel(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        make_relief(layers, Carving(depth=1.5), progress=cancel)


def test_the_fit_stays_within_the_depth_and_leaves_no_plateaus(layers):
    gains = []
    for depth in (0.5, 1.5, 4.0):
        carving = Carving(depth=depth, fillet=0.0)
        fitted = fit(layers, carving)
        low, high = fitted.span
        assert 0.5 * depth <= high - low <= depth
        assert low < -0.5 * depth < high
        gains.append(fitted.gain)
        relief, _ = make_relief(layers, carving)
        inner = relief.heights[1:-1, 1:-1][layers.mask[1:, 1:] & layers.mask[:-1, :-1]]
        assert (inner > -1e-9).mean() < 0.06
        assert (inner < 1e-9 - depth).mean() < (0.02 if depth > 1 else 0.15)
    assert gains == sorted(gains)
    assert gains[0] < gains[-1]


def test_iterations_do_not_grow_with_the_resolution_past_an_occlusion(layers, finer_layers):
    # Conjugate gradients to 1e-5 on the first Gauss-Newton system; half the figure
    # stands in front of the other half.
    counts = []
    for plain in (layers, finer_layers):
        depth = plain.depth.copy()
        depth[:, plain.grid.cols // 2 :] += 4.0
        torn = Layers(**{**vars(plain), "depth": depth * plain.mask})
        low = np.full(plain.grid.node_shape, -np.inf, np.float32)
        terms = terms_of(torn, Carving(depth=1.5), Fit((-1.4, -0.3), 1.0), (low, np.inf))
        here = linearise(terms, np.zeros(low.shape))
        _, count = solve(
            lambda x, out, t=here.tangent, f=terms.figure: t.apply(x, f, out),
            levels(here.tangent, terms.figure), -here.gradient, tolerance=1e-5,
        )  # fmt: skip
        counts.append(count)
    assert max(counts) <= 14
    assert counts[1] <= counts[0] + 2


def test_a_solution_is_gone_on_from(layers):
    _, before = make_relief(layers, Carving(depth=1.5), tolerance=1e-4)
    changed = Carving(depth=1.5, light_weight=1.5)
    warm, again = make_relief(layers, changed, start=before, tolerance=1e-5)
    cold, anew = make_relief(layers, changed, tolerance=1e-5)
    assert again.converged
    assert again.fitted == before.fitted
    assert again.energy["total"] == pytest.approx(anew.energy["total"], rel=0.02)
    assert np.abs(warm.heights - cold.heights).max() < 0.05
    _, same = make_relief(layers, changed, start=again, tolerance=1e-4)
    assert same.iterations == 0


def test_a_start_refitted_comes_to_what_nothing_comes_to(layers):
    _, shallow = make_relief(layers, Carving(depth=1.5))
    deep = Carving(depth=3.0)
    cold, _ = make_relief(layers, deep, tolerance=1e-3)
    start = refitted(shallow, layers, deep)
    warm, solution = make_relief(layers, deep, start=start, tolerance=1e-3)
    assert solution.converged
    assert np.abs(warm.heights - cold.heights).max() < 0.01 * 3.0
    # Its own fit is for half the depth, and would stay far from it.
    stale, _ = make_relief(layers, deep, start=shallow, tolerance=1e-3)
    assert np.abs(stale.heights - cold.heights).max() > 0.3 * 3.0


def test_how_it_went_is_told(layers):
    _, s = make_relief(layers, Carving(depth=1.5), tolerance=1e-5)
    assert s.converged
    assert s.residual <= 1e-5
    assert set(s.energy) == {"depth", "light", "line", "form", "total"}
    assert sum(v for k, v in s.energy.items() if k != "total") == pytest.approx(s.energy["total"])
    assert 0 < s.iterations <= s.inner < s.applications <= 160
