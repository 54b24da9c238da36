"""Cuts from Python: polynya.cut()."""
import numpy
import pytest

import polynya

SQUARE = numpy.array([[0, 0], [10, 0], [10, 10], [0, 10]])


def area_of(rings):
    return sum(0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1)) for x, y in (ring.T for ring in rings))


@pytest.mark.parametrize("tool", [{"disc": (10, 5, 3)}, {"crack": (5, 5, 30)}, {"by": SQUARE + 4},
                                  {"by": {"type": "Polygon", "coordinates": [(SQUARE / 2 + 2).tolist()]}}])
def test_a_cut_accounts_for_every_square_metre(tool):
    cut = polynya.cut(SQUARE, **tool)
    assert len(cut.pieces) == len(cut.parts) == cut.ledger["pieces"] == 2
    assert cut.ledger["exact_defect_m2"] == "0"
    assert sum(map(area_of, cut.pieces)) == pytest.approx(100, rel=1e-12)


def test_a_cut_takes_shapes_with_holes_and_refuses_what_is_none():
    class Shape:
        __geo_interface__ = {"type": "Polygon", "coordinates": [SQUARE.tolist(), (SQUARE[::-1] / 5 + 4).tolist()]}

    for shape in (Shape(), [SQUARE, SQUARE[::-1] / 5 + 4]):
        assert sum(map(area_of, polynya.cut(shape, crack=(5, 5, 90)).pieces)) == pytest.approx(96)
    assert len(polynya.cut(SQUARE, disc=(10, 5, 3), keep="outside").pieces) == 1
    bow_tie = SQUARE[[0, 2, 1, 3]]
    with pytest.raises(ValueError, match=r"self-crossing at \(5, 5\)"):
        polynya.cut(bow_tie, crack=(5, 5, 0))
    assert polynya.cut(bow_tie, crack=(5, 0, 90), repair="even-odd").pieces


def test_a_cut_of_shapelys_polygon():
    geometry = pytest.importorskip("shapely.geometry")
    holed = geometry.Polygon(SQUARE, [SQUARE / 5 + 4])
    cut = polynya.cut(holed, by=geometry.box(5, -1, 11, 11))
    assert sorted(round(area_of(piece), 9) for piece in cut.pieces) == [48, 48]
    with pytest.raises(ValueError, match="not a LineString"):
        polynya.cut(geometry.LineString(SQUARE), disc=(0, 0, 1))


@pytest.mark.parametrize("wrong, error", [
    (lambda: polynya.cut(None, disc=(0, 0, 1)), TypeError),
    (lambda: polynya.cut("floe", disc=(0, 0, 1)), ValueError),
    (lambda: polynya.cut(numpy.zeros((4, 1)), disc=(0, 0, 1)), ValueError),
    (lambda: polynya.cut(numpy.full((4, 2), numpy.nan), disc=(0, 0, 1)), ValueError),
    (lambda: polynya.cut(SQUARE[:2], disc=(0, 0, 1)), ValueError),
    (lambda: polynya.cut(SQUARE), TypeError),
    (lambda: polynya.cut(SQUARE, disc=(0, 0)), ValueError),
    (lambda: polynya.cut([], disc=(0, 0, 1)), ValueError),
    (lambda: polynya.cut(SQUARE, disc="abc"), ValueError),
    (lambda: polynya.cut(SQUARE, disc=(0, 0, -1)), ValueError),
    (lambda: polynya.cut(SQUARE, disc=(10, 5, 3), keep="left"), ValueError),
    (lambda: polynya.cut(SQUARE, disc=(10, 5, 3), repair="maybe"), ValueError),
    (lambda: polynya.cut({"type": "MultiPolygon", "coordinates": [[SQUARE.tolist()]]}, disc=(0, 0, 1)), ValueError),
])
def test_wrong_cuts_are_refused(wrong, error):
    with pytest.raises(error):
        wrong()
