import re
import subprocess
import sys
from pathlib import Path

README = (Path(__file__).parent.parent / "README.md").read_text(encoding="utf-8")


def test_the_python_of_the_readme_runs_as_it_stands(tmp_path):
    blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    assert len(blocks) == 1
    ran = subprocess.run(
        [sys.executable, "-c", blocks[0]], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert "True" in ran.stdout
    assert (tmp_path / "panel.stl").stat().st_size > 100_000


def test_every_room_of_the_package_is_in_the_readme():
    package = Path(__file__).parent.parent / "relieffab"
    rooms = [p.name for p in package.iterdir() if (p / "__init__.py").is_file()]
    assert [room for room in rooms if f"`{room}/`" not in README] == []
