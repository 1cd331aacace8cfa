import struct
import subprocess
import sys

import numpy as np
import pytest
import trimesh

from relieffab.errors import InputError
from relieffab.studio import upload
from relieffab.studio.children import Children
from relieffab.studio.upload import LARGEST, parse, refuse_size, safe_name


@pytest.fixture
def children():
    children = Children()
    yield children
    children.close()


def test_a_model_is_read_in_a_process_of_its_own(ball, children):
    model = parse(ball, children)
    assert (model.name, model.triangles) == ("ball.obj", 5120)
    assert model.file == ball


@pytest.mark.parametrize(
    ("name", "safe"),
    [
        ("horse.ply", "horse.ply"),
        ("/etc/../tmp/Horse.STL", "Horse.stl"),
        ("..\\..\\evil.obj", "evil.obj"),
        ('a b\n"c".glb', "a-b-c.glb"),
        ("..stl", "model.stl"),
        ("日本.off", "model.off"),
        ("x" * 300 + ".3mf", "x" * 60 + ".3mf"),
    ],
)
def test_names_lead_nowhere(name, safe):
    assert safe_name(name) == safe


@pytest.mark.parametrize("name", ["", "horse", "horse.txt", "horse.ply/", "ply", "x.toml", "../.."])
def test_other_files_are_refused_by_name(name):
    with pytest.raises(InputError, match="not a model file"):
        safe_name(name)


def test_a_file_of_2_gb_is_refused():
    refuse_size(LARGEST)
    with pytest.raises(InputError, match="too large for the studio"):
        refuse_size(2 << 30)


def _nan(path):
    ball = trimesh.creation.icosphere(subdivisions=1)
    ball.vertices[3] = np.nan
    path.write_bytes(trimesh.exchange.ply.export_ply(ball))


TRAPS = {
    "text.stl": lambda path: path.write_text("Dear Sir, here is the model you asked for.\n"),
    "lies.stl": lambda path: path.write_bytes(bytes(80) + struct.pack("<I", 2**32 - 1) + bytes(50)),
    "not.3mf": lambda path: path.write_bytes(b"PK\x03\x04 no more"),
    "nan.ply": _nan,
    "lies.png": lambda path: path.write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(99))),
    "noise.ply": lambda path: path.write_bytes(
        b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
        b"property float x\nproperty float y\nproperty float z\nend_header\n" + bytes(100)
    ),
}


@pytest.mark.parametrize("name", TRAPS)
def test_every_trap_is_told_with_its_file_and_no_more_of_its_path(name, tmp_path, children):
    path = tmp_path / name
    TRAPS[name](path)
    with pytest.raises(InputError) as told:
        parse(path, children)
    assert told.value.parts["where"] == name
    assert str(tmp_path) not in str(told.value)


def _instead(monkeypatch, code):
    """Run this code where the parser would run, its limits set."""
    original = subprocess.Popen
    program = f"from relieffab.studio import parse; parse._limit()\n{code}"

    def popen(command, **options):
        return original([sys.executable, "-c", program, *command[3:]], **options)

    monkeypatch.setattr("relieffab.studio.children.subprocess.Popen", popen)


def test_a_parser_that_takes_all_memory_is_told(ball, children, monkeypatch):
    code = (
        "parse.read_mesh = lambda path: bytearray(parse.MEMORY)\n"
        "import sys; sys.exit(parse.main(sys.argv[1:]))"
    )
    _instead(monkeypatch, code)
    with pytest.raises(InputError, match="more memory than the studio gives it"):
        parse(ball, children)


def test_a_parser_that_ends_without_a_word_is_told(ball, children, monkeypatch):
    _instead(monkeypatch, "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)")
    with pytest.raises(InputError, match="cannot be read"):
        parse(ball, children)


def test_a_parser_that_takes_forever_is_ended(ball, children, monkeypatch):
    monkeypatch.setattr(upload, "PATIENCE", 0.5)
    _instead(monkeypatch, "import time; time.sleep(1000)")
    with pytest.raises(InputError, match="too long"):
        parse(ball, children)
    assert children.running == 0


def test_a_parser_that_burns_the_processor_is_ended(ball, children, monkeypatch):
    code = "import resource; resource.setrlimit(resource.RLIMIT_CPU, (1, 5))\nwhile True: pass"
    _instead(monkeypatch, code)
    with pytest.raises(InputError, match="too long"):
        parse(ball, children)
