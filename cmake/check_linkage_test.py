"""The test of names without linkage itself: what is planted is found, and what may share a name is not.

    python3 cmake/check_linkage_test.py SOURCE
"""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_linkage  # noqa: E402

SOURCE = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else ".")
CLASHES = [
    ("struct Moments {\n  double a;\n};", "struct Moments {\n  int b = f({1, 2});\n};"),
    ("enum class Kind { kOne };", "class Kind {};"),
    ("constexpr double kFar = 1e9;", "constexpr int kFar{3};"),
    ("const std::map<int, std::string> kNames{{1, \"a;{\"}};", "constexpr std::array kNames{1, 2};"),
    ("double number(const Value& value, std::string_view key) {\n  return {};\n}",
     "double number(const Value& of, std::string_view words = \"}\") { return 0; }"),
    ("template <class T>\nstruct Box {};", "struct Box;"),
    ("using Row = std::vector<double>;", "using Row = std::array<double, 3>;"),
    ("void f() {}", "struct f {};"),
]
HARMLESS = [
    ("void add(int a) {}", "void add(double a) {}"),
    ("using geometry::Point;", "using geometry::Point;"),
    ("using Row = std::vector<double>;", "using Row = std::vector<double>;"),
    ("struct A { struct Inner {}; };", "struct B { struct Inner {}; };"),
    ("void f() { struct Local {}; }", "void g() { struct Local {}; }"),
    ("// struct Moments {};", "struct Moments {};"),
]


def source(text, namespace="polynya::io", is_unnamed=True):
    inner = f"namespace {{\n\n{text}\n\n}}  // namespace" if is_unnamed else text
    return f"#include <cmath>\n#define WORD struct Moments {{}};\n\nnamespace {namespace} {{\n{inner}\n}}\n"


class CheckLinkage(unittest.TestCase):
    def clashes(self, first, second):
        sources = {"a.cpp": first, "b.cpp": second}
        return [*check_linkage.clashes_in(sources), *check_linkage.hidden_in(sources)]

    def test_the_source_is_clean(self):
        self.assertEqual(check_linkage.main(SOURCE), 0)

    def test_what_clashes_is_found(self):
        for first, second in CLASHES:
            with self.subTest(first=first):
                self.assertEqual(len(self.clashes(source(first), source(second))), 1)
                self.assertEqual(len(self.clashes(source(second), source(first))), 1)
                self.assertEqual(self.clashes(source(first), source(second, "polynya::views")), [])

    def test_what_may_share_a_name_is_left_alone(self):
        for first, second in HARMLESS:
            with self.subTest(first=first):
                self.assertEqual(self.clashes(source(first), source(second)), [])

    def test_constants_and_static_functions_need_no_unnamed_namespace(self):
        for text in ("constexpr int kMost = 3;", "static int f() {\n  return 1;\n}"):
            self.assertEqual(len(self.clashes(source(text, is_unnamed=False), source(text, is_unnamed=False))), 1)
        for text in ("int f() {\n  return 1;\n}", "struct Point;"):
            self.assertEqual(self.clashes(source(text, is_unnamed=False), source(text, is_unnamed=False)), [])

    def test_a_constant_of_a_function_that_hides_anothers_is_found(self):
        hiding = source("void f() {\n  constexpr double kFar = 1;\n}")
        self.assertEqual(len(self.clashes(source("constexpr double kFar = 1e9;"), hiding)), 1)
        self.assertEqual(self.clashes(hiding, hiding.replace("void f", "void g")), [])


if __name__ == "__main__":
    unittest.main()
