import os
import time

import pytest

from relieffab.studio.children import Children

GRANDCHILD = """
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"])
print(child.pid, flush=True)
time.sleep(1000)
"""


@pytest.fixture
def module(tmp_path, monkeypatch):
    (tmp_path / "with_a_child.py").write_text(GRANDCHILD)
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    return "with_a_child"


def gone(pid):
    """Whether a process has ended, or is about to be buried by its new parent."""
    for _ in range(200):
        try:
            with open(f"/proc/{pid}/stat") as stat:  # noqa: PTH123
                if stat.read().rpartition(")")[2].split()[0] == "Z":
                    return True
        except FileNotFoundError:
            return True
        time.sleep(0.05)
    return False


def test_a_child_goes_with_all_that_it_started(module):
    children = Children()
    with children.child(module, []) as process:
        grandchild = int(process.stdout.readline())
        assert children.running == 1
    assert process.returncode is not None
    assert gone(grandchild)
    assert children.running == 0


def test_closing_ends_all_and_starts_no_more(module):
    children = Children()
    with children.child(module, []) as process:
        grandchild = int(process.stdout.readline())
        children.close()
        assert process.wait(10) == -9
        assert gone(grandchild)
    with pytest.raises(RuntimeError), children.child(module, []):
        pass
