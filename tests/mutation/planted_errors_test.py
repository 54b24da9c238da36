#!/usr/bin/env python3
"""What planted_errors.py plants, where, and that it leaves the sources as they were."""

import pathlib
import tempfile
import unittest

import planted_errors

LISTS = sorted(pathlib.Path(__file__).parent.glob("*.ndjson"))

SOURCE = """#include <cmath>
// a + b in a comment, 0.5 too
namespace polynya {
double law(double a, double b) {
  const double x = a + 0.5 * b;  // not - this
  if (x < b) return std::min(a, b);
  std::vector<double> many{1, 2, 3};
  print("a - b of 2.5");
  return x - 1e-3;
}
"""


def tree(folder):
    """A tree of sources with one source in each room."""
    root = pathlib.Path(folder)
    for room in planted_errors.ROOMS:
        (root / room).mkdir()
        (root / room / "law.cpp").write_text(SOURCE)
    return root


class PlantedErrors(unittest.TestCase):
    def planted_in(self, line):
        return [planted.strip() for _, planted in planted_errors.sites_of(line)]

    def test_signs_factors_bounds_and_comparisons(self):
        self.assertEqual(self.planted_in("  x = a + b;"), ["x = a - b;"])
        self.assertEqual(self.planted_in("  sum -= x;"), ["sum += x;"])
        self.assertEqual(self.planted_in("  if (a < b) {"), ["if (a <= b) {", "if (a > b) {"])
        self.assertEqual(self.planted_in("  return std::max(a, b);"), ["return std::min(a, b);"])
        self.assertEqual(self.planted_in("  y = 0.5 * x;"), ["y = 1.0 * x;", "y = 0.25 * x;"])

    def test_nothing_where_there_is_no_law(self):
        for line in ("// a + b", "#include <a>", "  std::vector<double> many;", '  print("a - b of 2.5");',
                     "  f(1, 2);", "  assert(a < b);", "  x = -a;  // b + c"):
            self.assertEqual(self.planted_in(line), [], line)

    def test_a_seed_draws_the_same_list_and_no_line_twice(self):
        with tempfile.TemporaryDirectory() as folder:
            root = tree(folder)
            first, second = planted_errors.drawn(root, 7, 8), planted_errors.drawn(root, 7, 8)
            self.assertEqual(first, second)
            self.assertNotEqual(first, planted_errors.drawn(root, 8, 8))
            self.assertEqual(len({(e["file"], e["line"]) for e in first}), 8)
            self.assertEqual({e["kind"] for e in first}, {"sign", "factor", "bound", "comparison"})

    def test_an_error_is_planted_and_taken_out_again(self):
        with tempfile.TemporaryDirectory() as folder:
            root = tree(folder)
            for error in planted_errors.drawn(root, 3, 8):
                path = root / error["file"]
                with planted_errors.Planted(error, root):
                    planted = path.read_text().splitlines()
                    changed = [i for i, (a, b) in enumerate(zip(SOURCE.splitlines(), planted)) if a != b]
                    self.assertEqual(changed, [error["line"] - 1])
                self.assertEqual(path.read_text(), SOURCE)

    def test_an_error_is_found_where_its_line_has_moved_and_stale_where_it_is_gone(self):
        with tempfile.TemporaryDirectory() as folder:
            root = tree(folder)
            error = planted_errors.drawn(root, 3, 1)[0]
            path = root / error["file"]
            path.write_text("// one line more\n" + SOURCE)
            self.assertEqual(planted_errors.place_of(error, root), error["line"])
            path.write_text("")
            self.assertIsNone(planted_errors.place_of(error, root))

    def test_each_error_of_the_lists_that_ship_has_a_result_with_its_reason(self):
        for path in LISTS:
            for error in planted_errors.read_list(path):
                self.assertIn(error["result"], (planted_errors.FOUND, planted_errors.SURVIVES,
                                                planted_errors.EQUIVALENT, planted_errors.STALE), error)
                self.assertTrue(error.get("by") or error.get("why") or error["result"] == planted_errors.STALE, error)

    def test_no_error_of_the_first_seed_survives_and_at_most_four_of_another(self):
        for path in LISTS:
            results = [error["result"] for error in planted_errors.read_list(path)]
            self.assertGreaterEqual(len(results), 40)
            self.assertLessEqual(results.count(planted_errors.SURVIVES), 0 if path.stem == "seed-1" else 4, path)


if __name__ == "__main__":
    unittest.main()
