"""Templates to HTML: every value escaped, and one that is missing an error."""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Template


def renderer(
    package: str, folder: str, name: str, **filters: Callable[[Any], str]
) -> Callable[..., str]:
    """Make what renders one template, which is read when it is first needed.

    Parameters
    ----------
    package, folder, name : str
        Where it lies: a package, a folder of it, a file.
    **filters
        What the template may write values with, beside Jinja's own.

    Returns
    -------
    callable
        Takes the template's values by their names, gives its text.
    """

    @cache
    def template() -> "Template":
        from jinja2 import Environment, PackageLoader, StrictUndefined

        there = Environment(
            loader=PackageLoader(package, folder),
            autoescape=True,
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        there.filters.update(filters)
        return there.get_template(name)

    return lambda **values: template().render(**values)
