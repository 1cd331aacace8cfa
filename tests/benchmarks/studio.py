"""How soon the studio's relief follows the hand.

    python tests/benchmarks/studio.py [MODEL ...]

Each kind of setting is dragged through a few positions, after one that does not count.  A
row gives the median and the worst of the times to a finished frame, as the worker takes
them; the processor's time, which other programs on the machine do not lengthen; and the
median of making the same from nothing in the same run, with its ratio.  `NUMBA_NUM_THREADS`
says how many threads there are.  Then each style: its depth dragged, without its marks, and
all of it once the hand rests; and programs.
"""

import os
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from statistics import median

from relieffab.job.settings import Job, default_job
from relieffab.layers.mesh import make_mesh, read_mesh
from relieffab.progress import silent
from relieffab.relief.style.names import STYLES
from relieffab.studio import looks
from relieffab.studio.ask import Ask
from relieffab.studio.model import Model, lightened
from relieffab.studio.preview import FINE, WIDTH, Preview
from relieffab.studio.trial import Trial
from relieffab.subject import scarab

STEPS = 9
DRAGS = {
    "depth": lambda k: {"depth": f"{2 + 0.25 * k:.3g}mm"},
    "line weight (depth)": lambda k: {"line_depth": f"{0.1 + 0.05 * k:.3g}mm"},
    "line width": lambda k: {"line_width": f"{0.5 + 0.05 * k:.3g}mm"},
    "line density": lambda k: {"line_detail": f"{1.6 + 0.2 * k:.3g}mm"},
    "shortest line": lambda k: {"line_length": f"{3 + 0.5 * k:.3g}mm"},
    "form length": lambda k: {"form_length": f"{1.5 + 0.25 * k:.3g}mm"},
    "wall angle": lambda k: {"wall_angle": f"{80 - 2 * k}deg"},
    "view (turned)": lambda k: {"azimuth": f"{20 + 3 * k}deg"},
    "view (tilted)": lambda k: {"azimuth": "20deg", "elevation": f"{2 * k}deg"},
}


def frame(preview: Preview, model: Model, job: Job) -> bytes:
    """Make what the page gets."""
    view = preview.view(Ask(model, job), silent)
    solved = preview.relief(view, job, silent)
    facts = {"ask": 1, "seconds": preview.seconds, "notes": []}
    return looks.preview_frame(view, solved, job, facts)


def timed(preview: Preview, model: Model, job: Job) -> tuple[float, float]:
    """Milliseconds by the clock and of the processor."""
    start, used = time.perf_counter(), time.process_time()
    frame(preview, model, job)
    return 1e3 * (time.perf_counter() - start), 1e3 * (time.process_time() - used)


def models(paths: list[str]) -> Iterator[Model]:
    """Read models; the scarab if none is named."""
    if not paths:
        yield lightened(make_mesh(*scarab(), name="scarab", usual_up="y"), Path("scarab"))
    for path in paths:
        yield lightened(read_mesh(path), Path(path))


def drag(name: str, model: Model, base: Job, width: int, *, whole: bool = False) -> None:
    """Drag one setting, and print its row."""
    preview, took, anew = Preview(width, whole=whole), [], []
    for k in range(STEPS + 1):
        typed = {**DRAGS[name](k)}
        changed = default_job(**typed)
        job = replace(base, **{key: getattr(changed, key) for key in typed})
        took.append(timed(preview, model, job))
        if k % 3 == 1:
            anew.append(timed(Preview(width, whole=whole), model, job))
    wall, used = zip(*took[1:], strict=True)
    nothing, nothing_used = (median(column) for column in zip(*anew, strict=True))
    print(
        f"{name:<20} {median(wall):6.0f} {max(wall):6.0f}   {median(used):6.0f} {max(used):6.0f}"
        f"   {nothing:6.0f} {nothing_used:6.0f}   {nothing_used / median(used):5.1f}"
    )


def main() -> None:
    """Print a table a model."""
    print(f"{os.environ.get('NUMBA_NUM_THREADS', 'all')} threads, {os.cpu_count()} cores")
    for model in models(sys.argv[1:]):
        base = replace(default_job(model="model"), up=model.up)
        frame(Preview(), model, base)
        frame(Preview(FINE, whole=True), model, base)
        for width, whole in ((WIDTH, False), (FINE, True)):
            count = len((model.shown if whole else model.tried).faces)
            print(f"\n{model.name}: {width} wide, {count:,} triangles")
            print(" " * 22 + "wall  worst      cpu  worst     anew    cpu   ratio (ms, cpu)")
            for name in DRAGS:
                drag(name, model, base, width, whole=whole)
        for name in STYLES[1:]:
            styled(name, model, base)
        trial(model, base)


def styled(name: str, model: Model, base: Job) -> None:
    """Time a style: a depth that is dragged, and the marks once the hand rests."""
    job = replace(base, style=name)
    hand, rest, took = Preview(), Preview(FINE, whole=True), []
    for k in range(STEPS + 1):
        took.append(timed(hand, model, replace(job, depth=2 + 0.25 * k)))
    start, used = time.perf_counter(), time.process_time()
    view = rest.view(Ask(model, job), silent)
    rest.marked(view, job, silent)
    wall, cpu = time.perf_counter() - start, time.process_time() - used
    moved, of_clock = (median(column) for column in zip(*took[1:], strict=True))
    print(
        f"{name:<20} {moved:6.0f} ms dragged, {of_clock:.0f} cpu; "
        f"at rest {wall:.1f} s, {cpu:.1f} cpu, {view.layers.grid.cols} wide: "
        + ", ".join(f"{k} {v:.1f}" for k, v in rest.seconds.items())
    )


def trial(model: Model, base: Job) -> None:
    """Time programs at the page's size, and moments of them."""
    preview, tried = Preview(), Trial()
    solved = preview.relief(preview.view(Ask(model, base), silent), base, silent)
    tried.carry_out(solved, base, silent)
    start, used = time.perf_counter(), time.process_time()
    last = tried.carry_out(solved, base, silent)
    print(
        f"\ntoolpaths            {time.perf_counter() - start:6.1f} s wall, "
        f"{time.process_time() - used:.1f} s cpu; {sum(len(r.points) for r in last.runs):,} moves"
    )
    took = []
    for k in range(40):
        start = time.perf_counter()
        tried.carved(last.states.seconds * k / 39)
        took.append(1e3 * (time.perf_counter() - start))
    print(f"a moment of them     {median(took):6.1f} ms, at worst {max(took):.1f}")


if __name__ == "__main__":
    main()
