import hashlib
import json

import pytest

from relieffab.cli.certificate import check_certificate
from relieffab.errors import InputError


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "02-finish.nc"
    path.write_text("G0X1\n")
    return path


def report(program, **part):
    data = {"schema": 1, "programs": [{"file": program.name, **part}]}
    (program.parent / "report.json").write_text(json.dumps(data))


def test_the_verified_program_is_let_through_in_silence(program):
    report(program, sha256=hashlib.sha256(program.read_bytes()).hexdigest())
    assert check_certificate(program) == ""


def test_a_changed_program_is_refused(program):
    report(program, sha256=hashlib.sha256(b"G0X2\n").hexdigest())
    with pytest.raises(InputError, match="changed after it was verified"):
        check_certificate(program)


def test_what_nothing_vouches_for_is_noted(program):
    assert "no report.json" in check_certificate(program)
    report(program)
    assert "no hash" in check_certificate(program)


@pytest.mark.parametrize("text", ["{", "[]", '{"programs": [1]}', '{"programs": [{}]}'])
def test_a_damaged_report_is_refused(program, text):
    (program.parent / "report.json").write_text(text)
    with pytest.raises(InputError, match="cannot be read"):
        check_certificate(program)
