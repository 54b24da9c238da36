"""The test of paths itself: paths that are planted are found, and others are not.

    python3 tests/docs/check_paths_test.py SOURCE
"""
import pathlib
import sys
import unittest

import check_paths

SOURCE = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else ".").resolve()
FILES = ["io/run/records.cpp", "io/run/records.hpp", "docs/view.md", "tests/fuzz/cut_corpus/one", "setup.sh",
         "python/polynya/study/options.py", "scenes/pack.json"]


class CheckPaths(unittest.TestCase):
    def missing(self, text):
        return list(check_paths.Tree(FILES).missing(text))

    def test_the_source_names_nothing_that_is_gone(self):
        self.assertEqual(check_paths.main(SOURCE), 0)

    def test_what_is_not_there_is_found(self):
        for text, path in (("see io/run/gone.cpp.", "io/run/gone.cpp"), ("`docs/gone/x.cpp`", "docs/gone/x.cpp"),
                           ("(gone.hpp)", "gone.hpp"), ("io/run/{records,gone}.cpp", "io/run/gone.cpp"),
                           ("scenes/gone.json", "scenes/gone.json"), ("tests/fuzz/NAME_seeds", "tests/fuzz/NAME_seeds"),
                           ("run/gone.cpp", "run/gone.cpp")):
            with self.subTest(text=text):
                self.assertEqual(set(self.missing(text)), {path})

    def test_what_is_there_or_is_no_path_is_left_alone(self):
        for text in ("io/run/records.cpp:12", "`records.hpp`", "io/run/records.{cpp,hpp}", "docs/*.md", "io/run/",
                     "python/polynya/NAME/options.py", "tests/fuzz/NAME_corpus", "and/or, km/h", "boost/crc.hpp",
                     "runs/my-run/forces.csv", "https://example.org/io/run/gone.cpp", "build/dev/app/polynya"):
            with self.subTest(text=text):
                self.assertEqual(self.missing(text), [])

    def test_of_sources_comments_are_read(self):
        for name, text in (("a.cpp", 'f("io/x.cpp");  // io/y.cpp'), ("a.py", 'f("io/x.cpp")  # io/y.cpp'),
                           ("CMakeLists.txt", "add(io/x.cpp)  # io/y.cpp"), ("a.md", "io/y.cpp")):
            with self.subTest(name=name):
                read = check_paths.read_by_people(name, text)
                self.assertIn("io/y.cpp", read)
                self.assertNotIn("io/x.cpp", read)
        self.assertEqual(check_paths.read_by_people("a.json", "io/y.cpp"), "")


if __name__ == "__main__":
    unittest.main()
