"""A page of a study stands alone, says what was put in, and appears whole or not at all."""

from pathlib import Path

import pytest
from matplotlib.figure import Figure

from sensorsim.errors import InputError
from sensorsim.study.page import Page


def test_page_holds_text_tables_and_pictures_and_loads_nothing(tmp_path: Path) -> None:
    page = Page("Errors < 1 K")
    page.heading("Table")
    page.text("a & b")
    page.table(("case", "margin [K]"), (("skin <script>", 0.123456789), ("sky", 2)), alarm=(False, True))
    figure = Figure()
    figure.subplots().plot([0, 1], [0, 1])
    page.figure(figure, "A line")
    page.write(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Errors &lt; 1 K" in text
    assert "a &amp; b" in text
    assert "skin &lt;script&gt;" in text
    assert '<td class="number">0.12346</td>' in text
    assert text.count('class="alarm"') == 1
    assert 'src="data:image/png;base64,' in text
    assert "http" not in text.replace("http-equiv", "")
    assert list(tmp_path.iterdir()) == [tmp_path / "page.html"]


def test_page_refuses_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be written: No such file"):
        Page("x").write(tmp_path / "nowhere" / "page.html")
    assert not list(tmp_path.iterdir())
