"""Numbers in the words of the page."""

from collections.abc import Sequence


def clock(seconds: float) -> str:
    """Write seconds as hours and minutes.

    Examples
    --------
    >>> clock(5025)
    '1 h 24 min'
    >>> clock(42)
    '1 min'
    """
    minutes = max(1, round(seconds / 60))
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min"


def mm(value: float) -> str:
    """Write a length with no more digits than it has to a thousandth of a millimetre.

    Examples
    --------
    >>> mm(12.0), mm(3.175), mm(-0.0001)
    ('12', '3.175', '0')
    """
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def sides(values: Sequence[float]) -> str:
    """Write lengths that belong together.

    Examples
    --------
    >>> sides((120, 90, 12))
    '120 × 90 × 12 mm'
    """
    return " × ".join(map(mm, values)) + " mm"  # noqa: RUF001


def span(low: float, high: float) -> str:
    """Write a range of positions to a hundredth of a millimetre.

    Examples
    --------
    >>> span(-3, 5.006)
    '-3 to 5.01'
    """
    return f"{mm(round(low, 2))} to {mm(round(high, 2))}"
