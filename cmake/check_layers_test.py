"""The layer test itself: what is planted into a copy of the source's headers is found, and nothing else.

    python3 cmake/check_layers_test.py SOURCE
"""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_layers  # noqa: E402

SOURCE = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else ".")
# Each row is a source file and an include that the test adds to it.
PLANTED = [
    ("geometry/shape/point.hpp", '"geometry/cut/cut.hpp"'),  # up, between sub-rooms
    ("geometry/cut/cut.cpp", '"geometry/contact/boundary.hpp"'),  # sideways
    ("fracture/crushing.cpp", '"dynamics/bodies.hpp"'),  # down, between rooms that are blind to each other
    ("dynamics/contact/contact.hpp", '"dynamics/water/flow.hpp"'),  # sideways, between sub-rooms
    ("dynamics/bodies.hpp", '"dynamics/contact/contact.hpp"'),  # up, into a sub-room
    ("simulation/world/step.cpp", '"io/scene/scene_reader.hpp"'),  # up
    ("io/run/run_writer.cpp", '"views/map/picture.hpp"'),  # up: the writer draws nothing
    ("io/scene/scene_check.cpp", '"geometry/cut/internal/cut_graph.hpp"'),  # another room's internals
    ("io/scene/scene_reader.cpp", "<nlohmann/json.hpp>"),  # foreign, elsewhere
    ("simulation/world/world.cpp", "<CGAL/Polygon_2.h>"),
    ("geometry/cut/cut.hpp", "<CGAL/Polygon_2.h>"),  # a header of its room, but a public one
    ("app/run/run.cpp", "<CLI/CLI.hpp>"),
    ("geometry/shape/point.hpp", "<Eigen/Dense>"),
    ("app/run/run.cpp", "<zlib.h>"),  # listed nowhere
]


class CheckLayers(unittest.TestCase):
    def test_the_source_is_clean(self):
        self.assertEqual(check_layers.main(SOURCE), 0)

    def test_what_is_planted_is_found(self):
        for path, include in PLANTED:
            with self.subTest(path=path, include=include):
                text = (SOURCE / path).read_text()
                self.assertEqual(list(check_layers.problems_of(path, text)), [])
                planted = list(check_layers.problems_of(path, f"#include {include}\n" + text))
                self.assertEqual(len(planted), 1, planted)
                self.assertTrue(planted[0].startswith(f"{path}:1: "), planted)

    def test_a_circle_of_python_modules_is_found(self):
        imports = check_layers.python_imports(SOURCE)
        self.assertEqual(list(check_layers.circles(imports)), [])
        self.assertIn("polynya.results.tables", imports["polynya.results.run"])
        imports["polynya.results.tables"].add("polynya.results.run")
        modules = ["run", "channel", "tables", "run"]
        circle = " imports ".join(f"polynya.results.{module}" for module in modules)
        self.assertEqual(list(check_layers.circles(imports)), [circle])


if __name__ == "__main__":
    unittest.main()
