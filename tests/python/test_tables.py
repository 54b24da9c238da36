"""The tables of pages: which cells agree, and that each script has the tables of its page."""
import importlib
import pathlib
import re
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "studies"))
import tables  # noqa: E402

PAGES = ("validation", "bow", "paper", "reliability", "performance", "brash", "management")


@pytest.mark.parametrize("old, new", [
    ("437 ± 2", "441 ± 2"), ("437 ± 2", "445 ± 2"), ("0.238 ± .013", "0.25 ± 0.014"), ("12", "13"), ("1000", "1019"),
    ("0.5, 10 %", "0.51, 10 %"), ("", ""), ("−48.7°", "-48.7°"), ("split", "split"), ("5.99 (0.49)", "6.05 (0.48)")])
def test_cells_agree_within_their_error(old, new):
    assert tables.agree(old, new, 0.02) and tables.agree(new, old, 0.02)


@pytest.mark.parametrize("old, new", [
    ("437 ± 2", "450 ± 2"), ("437 ± 2", "437"), ("100", "105"), ("0.50", "0.53"), ("split", "bend"), ("1, 2", "1"),
    ("", "1"), ("10 %", "10"), ("5.99 (0.49)", "5.99 (0.59)"), ("-1.0", "1.0")])
def test_cells_that_state_something_else_do_not_agree(old, new):
    assert not tables.agree(old, new, 0.02) and not tables.agree(new, old, 0.02)


def test_a_table_is_read_back_from_its_page_and_differences_name_their_cells():
    table = tables.Table(["h [m]", "sum"], [["0.5", "437 ± 2"], ["1", ""]])
    assert tables.of_markdown(str(table)) == (["h [m]", "sum"], [["0.5", "437 ± 2"], ["1", ""]])
    assert list(tables.differences("t", str(table), table)) == []
    other = tables.Table(["h [m]", "sum"], [["0.5", "500 ± 2"], ["1", ""]])
    assert list(tables.differences("t", str(table), other)) == [
        "t, row 1 (0.5), sum: the page has 437 ± 2, found 500 ± 2"]
    shorter = tables.Table(["h [m]", "sum"], [["0.5", "437 ± 2"]])
    assert len(list(tables.differences("t", str(table), shorter))) == 1


def test_means_have_their_standard_error():
    assert tables.mean_and_error([1, 2, 3, 4]) == pytest.approx((2.5, (5 / 3 / 4) ** 0.5))


@pytest.mark.parametrize("name", PAGES)
def test_each_script_makes_the_tables_of_its_page(name):
    script = importlib.import_module(name)
    in_page = re.findall(r"<!-- table: (\S+) -->", (ROOT / script.PAGE).read_text(encoding="utf-8"))
    assert sorted(in_page) == sorted(script.TABLES) and len(set(in_page)) == len(in_page)


def test_no_page_has_a_table_that_no_script_makes():
    pages = {importlib.import_module(name).PAGE for name in PAGES}
    marked = {path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md")
              if "<!-- table: " in path.read_text(encoding="utf-8")}
    assert marked == pages
