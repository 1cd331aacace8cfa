import pytest
from jinja2 import UndefinedError

from relieffab.html import renderer


def page(tmp_path, monkeypatch, text):
    """A renderer of a package made for the purpose."""
    folder = tmp_path / "a_package_of_pages" / "pages"
    folder.mkdir(parents=True)
    (folder.parent / "__init__.py").write_text("")
    (folder / "page.html").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(__import__("sys").modules, "a_package_of_pages", raising=False)
    return renderer("a_package_of_pages", "pages", "page.html", loud=str.upper)


def test_values_are_escaped_and_filtered(tmp_path, monkeypatch):
    render = page(tmp_path, monkeypatch, "{{ name|loud }}{% if True %}\n!{% endif %}")
    assert render(name="<b>") == "&lt;B&gt;!"
    assert render(name="again") == "AGAIN!"


def test_a_value_that_is_missing_is_an_error(tmp_path, monkeypatch):
    with pytest.raises(UndefinedError, match="name"):
        page(tmp_path, monkeypatch, "{{ name }}")()
