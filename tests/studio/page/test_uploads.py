import pytest

BAD = {
    "words.stl": b"this is a letter to a friend, and no model at all\n" * 40,
    "empty.ply": b"",
    "cut.ply": b"ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\n",
    "picture.obj": bytes(range(256)) * 20,
    "strange.xyz": b"0 0 0\n1 0 0\n",
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_gives_a_message_and_the_studio_lives_on(carver, name, tmp_path):
    path = tmp_path / name
    path.write_bytes(BAD[name])
    carver.page.set_input_files("#file", path)
    carver.waits("document.querySelectorAll('#messages .message').length === 1")
    told = carver.page.inner_text("#messages")
    assert len(told) > 20
    assert "Traceback" not in told
    assert carver.page.inner_text("#model-name") == "scarab.stl"
    carver.sees("studio.store.change({depth: '2.5mm'})")
    carver.goes_to("relief")
    assert carver.is_shown_what_it_asked()["depth_mm"] == 2.5


def test_a_file_too_large_is_not_sent(carver, tmp_path):
    path = tmp_path / "huge.stl"
    with path.open("wb") as file:
        file.truncate(2 << 30)
    sent = []
    carver.page.on("request", lambda request: sent.append(request.url))
    carver.page.set_input_files("#file", path)
    carver.waits("document.querySelectorAll('#messages .message').length === 1")
    assert "too large" in carver.page.inner_text("#messages")
    assert sent == []


def test_a_setting_that_cannot_be_is_told_at_its_field(carver):
    carver.goes_to("relief")
    carver.page.fill("#set-depth", "deep")
    carver.page.keyboard.press("Enter")
    carver.waits("document.querySelectorAll('#messages .message').length === 1")
    assert "deep" in carver.page.inner_text("#messages")
    assert carver.page.get_attribute("#set-depth", "aria-invalid") == "true"
    carver.page.keyboard.press("Escape")
    carver.page.fill("#set-depth", "2mm")
    carver.page.keyboard.press("Enter")
    carver.calm()
    assert carver.page.inner_text("#messages") == ""
    assert carver.page.get_attribute("#set-depth", "aria-invalid") == "false"
