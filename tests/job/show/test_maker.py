from relieffab.job.show.maker import header, run_of


def test_elsewhere_its_header_tells_what_it_was_made_for(job, tmp_path):
    alone = tmp_path / "02-finish.nc"
    alone.write_bytes((job / "02-finish.nc").read_bytes())
    run = run_of(alone)
    assert [cutter.name for cutter in run.cutters] == ["tapered-ball-1"]
    assert (run.stock.width, run.stock.height, run.stock.thickness) == (40, 30, 12)
    assert run.machine.name == "3018-prover"


def test_headers():
    text = "(cutter T1: a, flat)\n(cutter T2: b, ball)\n(plain words)\nG21\n(cutter: c)\n"
    assert header(text) == {"cutter T1": "a, flat", "cutter T2": "b, ball"}
    assert header("; machine: mine, LinuxCNC\n") == {"machine": "mine, LinuxCNC"}


def test_programs_come_in_the_order_of_their_job(job):
    run = run_of(job / "03-lines.nc")
    assert [program.name for program in run.programs] == [
        "01-rough.nc",
        "02-finish.nc",
        "03-lines.nc",
    ]
    assert len(run.cutters) == 3
    assert [program.name for program in run.asked] == ["03-lines.nc"]
