"""The stock in words: its measures, and where work zero is."""

from relieffab.job.sheet.words import mm, sides
from relieffab.round import Curved, Round
from relieffab.stock import Stock


def measures(stock: Stock, bent: Round | Curved | None = None) -> str:
    """Say how large a stock is, and of what form.

    Examples
    --------
    >>> measures(Stock(45, 60, 20, radius=20), Round(60, 45, 40, bore=30, floor=5))
    'round, 40 mm thick, 45 mm long, bored 30 mm wide down to 5 mm above its foot'
    """
    if isinstance(bent, Round):
        bore = f", bored {mm(bent.bore)} mm wide" if bent.bore else ""
        floor = f" down to {mm(bent.floor)} mm above its foot" if bent.floor else ""
        return f"round, {mm(bent.diameter)} mm thick, {mm(bent.length)} mm long{bore}{floor}"
    if bent is not None:
        size = sides((bent.width, bent.height, bent.thickness))
        return f"{size}, its face curved along X with a radius of {mm(bent.radius)} mm"
    size = sides((stock.width, stock.height, stock.thickness))
    return size if stock.outline.plain else f"{size}, {stock.shape}"


def zero(stock: Stock) -> str:
    """Say where work zero is."""
    x, y, z = stock.work_zero
    if stock.radius:
        level = "on the face" if z == 0 else "on the axis"
        return (
            f"{mm(x)} mm along the axis from the figure's top, {mm(y)} mm round the face from its "
            f"right edge, {level}; the stock is {mm(2 * stock.radius)} mm thick and turns about X"
        )
    face = (
        "on the middle of the stock's face, its highest" if stock.curve else "on the stock's face"
    )
    level = face if z == 0 else "under the stock, on the table"
    if x == 0 and y == 0:
        return f"the stock's near left corner, {level}"
    return f"{mm(x)} mm right and {mm(y)} mm up from the stock's near left corner, {level}"
