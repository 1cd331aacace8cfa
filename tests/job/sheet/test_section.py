from relieffab.fittings import Frame
from relieffab.job.sheet import section
from relieffab.stock import Stock


def test_heights_are_told():
    drawing = section.draw(Stock(120, 90, 12), 3.0, {"safe_height": 5.0})
    words = {word.text for word in drawing.words}
    assert words == {"12 mm", "3 mm deep", "rapids at Z 5", "Z 0"}


def test_z_is_told_from_where_work_zero_is():
    stock = Stock(120, 90, 12, (0, 0, -12))
    drawing = section.draw(stock, 3.0, {"safe_height": 5.0})
    assert "rapids at Z 17" in {word.text for word in drawing.words}


def test_even_a_high_frame_stays_on_the_page():
    stock = Stock(120, 90, 4, frame=Frame(8, 30))
    drawing = section.draw(stock, 0.0, None)
    numbers = [
        float(n)
        for line in drawing.lines
        if line.kind != "origin"
        for n in line.path.split()
        if _is_number(n)
    ]
    assert min(numbers) >= 0
    assert not any("deep" in word.text or "rapids" in word.text for word in drawing.words)


def _is_number(text):
    return text.replace(".", "").replace("-", "").isdigit()
