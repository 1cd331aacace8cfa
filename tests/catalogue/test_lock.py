import os
import subprocess
import sys

import pytest

from relieffab.catalogue.lock import LOCK, holds, locked
from relieffab.errors import InputError


def test_a_folder_is_one_batch_s_at_a_time(tmp_path):
    with locked(tmp_path) as token:
        assert holds(tmp_path, token)
        assert not holds(tmp_path, "other")
        with (
            pytest.raises(InputError, match=f"(?s)another batch.*process {os.getpid()} on "),
            locked(tmp_path),
        ):
            pass
        assert holds(tmp_path, token)
    assert not (tmp_path / LOCK).exists()
    assert not holds(tmp_path, token)
    with locked(tmp_path):
        pass


def test_a_process_that_died_holds_nothing(tmp_path):
    code = (
        "import os, sys; from pathlib import Path; from relieffab.catalogue.lock import locked\n"
        "with locked(Path(sys.argv[1])): os._exit(0)"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path)], check=True)
    assert (tmp_path / LOCK).exists()
    with locked(tmp_path) as token:
        assert holds(tmp_path, token)
