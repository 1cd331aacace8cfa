"""A report as a job leaves it, with two programs, and one without."""

from dataclasses import asdict

import pytest

from relieffab import profiles
from relieffab.job.report import start_report
from relieffab.job.settings import job_of, resolve
from relieffab.job.stocks import machine_of, milled_of, round_of, stock_of
from relieffab.machine import cutting


def program(number, name, cutter, deep, job):
    machine, material = profiles.machine(job.machine), profiles.material(job.material)
    return {
        "file": f"{number:02d}-{name}.nc",
        "cutter": asdict(cutter),
        "rpm": 10000.0,
        "feeds": asdict(cutting(cutter, material, machine)),
        "lines": 1234,
        "seconds": 1800.0,
        "cut_mm": 5000.0,
        "bounds_mm": [[10.0, 12.0, -deep], [110.0, 80.0, 5.0]],
        "sha256": f"{number:064x}",
    }


def make_report(**settings):
    """A report of a whole job."""
    chosen = resolve([("flag", {"model": "horse.ply", "view": "right", **settings})])
    report, job = start_report(chosen), job_of(chosen)
    machine, material = machine_of(job), profiles.material(job.material)
    stock = stock_of(job) if round_of(job) is None else milled_of(job)
    report |= {
        "model": {"name": "horse.ply", "notes": ["turned outward"], "sha256": "f" * 64},
        "relief": {
            "file": "relief.tiff",
            "rows": 91,
            "cols": 121,
            "pitch_mm": 1.0,
            "origin_mm": [0.0, 90.0],
            "depth_mm": 3.0,
            "converged": True,
            "sha256": "a" * 64,
        },
        "panel": {
            "file": "panel.stl",
            "files": ["panel.stl", "panel.3mf"],
            "triangles": 4000,
            "watertight": True,
            "volume_mm3": 125000.0,
            "max_error_mm": 0.019,
        },
        "machine": asdict(machine),
        "material": {**asdict(material), "notes": ["feeds are a careful guess: start slower"]},
        "slab": asdict(stock),
        "units": "mm",
        "aids": [{"file": "00-outline.nc", "sha256": "b" * 64}],
        "programs": [
            program(1, "rough", profiles.cutter("flat-3.175"), 2.5, job),
            program(2, "finish", profiles.cutter("tapered-ball-1"), 3.0, job),
        ],
        "verification": {
            "gouge_mm": 0.0,
            "excess_p99_mm": 0.08,
            "within_tolerance": 0.994,
            "tolerance_mm": 0.1,
            "seams": [],
            "air_cutting": 0.04,
            "ok": True,
            "findings": [],
        },
    }
    return report


@pytest.fixture
def made():
    """What makes a report of a whole job with other settings."""
    return make_report


@pytest.fixture
def report():
    return make_report()
