import pytest

from relieffab.errors import InputError
from relieffab.job.folder import REPORT, check_folder, finished_together


def test_files_arrive_together_and_the_scratch_folder_goes(tmp_path):
    target = tmp_path / "deep" / "job"
    with finished_together(target) as scratch:
        (scratch / "layers").mkdir()
        (scratch / "layers" / "a.png").write_text("a")
        (scratch / REPORT).write_text("{}")
        assert not target.exists()
    assert (target / "layers" / "a.png").read_text() == "a"
    assert [p.name for p in tmp_path.iterdir()] == ["deep"]


@pytest.mark.parametrize("fault", [ValueError, KeyboardInterrupt])
def test_after_a_fault_nothing_is_left(tmp_path, fault):
    with pytest.raises(fault), finished_together(tmp_path / "deep" / "job") as scratch:
        (scratch / "a").write_text("half")
        raise fault
    assert list(tmp_path.iterdir()) == []


def test_files_of_others_stay(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    with finished_together(tmp_path) as scratch:
        (scratch / REPORT).write_text("{}")
    assert (tmp_path / "mine.txt").read_text() == "mine"


def test_folders_that_cannot_take_a_job_are_refused(tmp_path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(InputError, match="is a file"):
        check_folder(tmp_path / "file", overwrite=True)
    with pytest.raises(InputError, match="already holds files"):
        check_folder(tmp_path, overwrite=False)
    (tmp_path / REPORT).write_text("{}")
    with pytest.raises(InputError, match="already holds a job"):
        check_folder(tmp_path, overwrite=False)
    check_folder(tmp_path, overwrite=True)
    check_folder(tmp_path / "new" / "one", overwrite=False)
    with pytest.raises(InputError, match=r"is a file|cannot be written"):
        check_folder(tmp_path / "file" / "below", overwrite=False)
