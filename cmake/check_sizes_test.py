"""The size test itself: what is planted is found, and what only resembles it is not.

    python3 cmake/check_sizes_test.py SOURCE
"""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_sizes  # noqa: E402

SOURCE = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else ".")
BODY = "  x();\n"
# Each row is the line that begins a function, the name of the function, and the line that ends the function.
CPP = [
    ("void plain(int a) {\n", "plain", "}\n"),
    ("tl::expected<int, Error> Class::member(const std::map<int, int>& a) const noexcept {\n", "Class::member", "}\n"),
    ("auto trailing(int a) -> std::vector<int> {\n", "trailing", "}\n"),
    ("Class::Class(int a) : a_(a), b_{a} {\n", "a function without a name", "}\n"),
    ("const auto lambda = [&](int a) mutable {\n", "a function without a name", "};\n"),
    ("const auto lambda = [this] {\n", "a function without a name", "};\n"),
]
JS = [
    ("function plain(a) {\n", "plain", "}\n"),
    ("const arrow = (a, { b }) => {\n", "a function without a name", "};\n"),
    ("const short = a => {\n", "a function without a name", "};\n"),
    ("class Shape {\n  method(a) {\n", "method", "  }\n}\n"),
]
# Braces and parentheses that are no code, and blocks that are no function.
CPP_HARMLESS = [
    'const char* text = "}{(";\n', "char brace = '}';\n", "int n = 1'000'000;\n", "// it's a }\n", "/* ) */\n",
    'auto raw = R"x(} ")" )x";\n', "namespace a {\n" + 60 * BODY + "}\n",
    "const Table kTable[] = {\n" + 60 * "  {1, 2},\n" + "};\n",
]
JS_HARMLESS = [
    'const text = "}{(";\n', "const text = '}\\'{';\n", "const text = `} ${f(`{${a}`, { b: 1 })} {`;\n",
    "const match = /[}/](?=\\{)/.test(a);\n",
    "// it's a }\n", "const half = a / 2 + b / 2;\n", "const table = {\n" + 60 * "  a: 1,\n" + "};\n",
]


def in_function(head, end, lines):
    """A function whose parameters begin in its last line of head; `lines` counts from there to its closing brace."""
    return head + (lines - 2) * BODY + end


class CheckSizes(unittest.TestCase):
    def problems(self, path, text):
        return list(check_sizes.problems_of(path, text))

    def test_the_source_is_clean(self):
        self.assertEqual(check_sizes.main(SOURCE), 0)
        seen = {path.relative_to(SOURCE).as_posix() for path in check_sizes.product_files(SOURCE)}
        self.assertLessEqual({"app/main.cpp", "geometry/shape/point.hpp", "views/player/player.js"}, seen)
        self.assertFalse([path for path in seen if "vendor" in path])

    def test_a_long_function_is_found_and_one_at_the_limit_is_not(self):
        most = check_sizes.MOST_LINES_OF_FUNCTION
        for path, kinds in (("a.cpp", CPP), ("a.js", JS)):
            for head, name, end in kinds:
                with self.subTest(head=head):
                    self.assertEqual(self.problems(path, in_function(head, end, most)), [])
                    line = head.count("\n")
                    self.assertEqual(self.problems(path, in_function(head, end, most + 1)),
                                     [f"{path}:{line}: {name} has {most + 1} lines, more than {most}"])

    def test_functions_with_many_parameters_are_counted(self):
        five, six = "(int a, std::map<int, int> b, const C& c = {1, 2}, int d, D (*e)(int, int)", ", int f"
        for head, name in (("void plain", "plain"), ("auto f = [&]", "a lambda"), ("A::A", "A::A")):
            for end in (") {\n}\n", ") const {\n}\n", ") : a_(a), b_{b} {\n}\n", ") -> std::vector<int> {\n}\n"):
                with self.subTest(head=head, end=end):
                    self.assertEqual(list(check_sizes.with_many_parameters("a.cpp", head + five + end)), [])
                    self.assertEqual(list(check_sizes.with_many_parameters("a.cpp", head + five + six + end)),
                                     [f"a.cpp:1: {name} has 6"])
        for text in ("call(a, b, c, d, e, f);\n", "if (is(a, b, c, d, e, f)) {\n}\n",
                     "void f(int, int, int, int, int, int);\n"):
            self.assertEqual(list(check_sizes.with_many_parameters("a.cpp", text)), [])

    def test_functions_within_count(self):
        inner = "  const f = () => {\n" + 30 * BODY + "  };\n"
        self.assertEqual(len(self.problems("a.js", "function outer() {\n" + 2 * inner + "}\n")), 1)

    def test_what_is_no_function_is_left_alone(self):
        for path, texts in (("a.cpp", CPP_HARMLESS), ("a.js", JS_HARMLESS)):
            for text in texts:
                with self.subTest(text=text):
                    self.assertEqual(self.problems(path, text), [])
        for control in ("if (a) {\n", "for (;;) {\n", "while (a) {\n", "switch (a) {\n", "if constexpr (a) {\n"):
            with self.subTest(control=control):
                self.assertEqual(self.problems("a.cpp", in_function(control, "}\n", 60)), [])

    def test_what_cannot_be_read_is_no_pass(self):
        self.assertEqual(self.problems("a.cpp", "void f() {\n"), ["a.cpp:1: '{' is never closed"])
        self.assertEqual(self.problems("a.js", "f();\n}\n"), ["a.js:2: '}' closes nothing that is open"])

    def test_every_table_that_is_excepted_is_there(self):
        for entry, reason in check_sizes.TABLES.items():
            self.assertTrue(reason)
            self.assertTrue((SOURCE / entry.split(":")[0]).exists(), entry)


if __name__ == "__main__":
    unittest.main()
