from relieffab.job.show.shown import stock_facts
from relieffab.stock import Stock


def test_a_stock_is_told_by_the_measures_of_its_form():
    assert stock_facts(Stock(40, 30, 12)) == {"stock_mm": [40, 30, 12]}
    assert stock_facts(Stock(45, 60, 8, radius=20)) == {"diameter_mm": 40, "length_mm": 45}
