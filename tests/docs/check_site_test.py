"""The check of the site itself: what is planted is found, and sound pages have nothing.

    python3 tests/docs/check_site_test.py SOURCE
"""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else ".")
sys.path.insert(0, str(SOURCE / "tools/site"))
import check  # noqa: E402
import build  # noqa: E402
import pages  # noqa: E402
import reference  # noqa: E402

KATEX = pathlib.Path("/usr/share/javascript/katex/katex.min.js")
DOCS = "docs"  # the pages below are of no file
HELP = """Cut a thing

Examples:
  polynya thing a.json            once
  polynya thing a.json --times 3 --slowly

Usage: polynya thing [OPTIONS] file

Options:
  -h,--help                   Print this help message and exit
  --times N:1 to 9=2          how often
  --angle DEG:0 to 89.9 REQUIRED
                              of the thing
  --opposite DEG:0 to 89.9123 Instead: the other one
  --keep inside|outside       which | stays

Exit codes: 0 done, 2 usage (also: no thing), 5 input/output, or no file.
"""
TEXTS = {"a.md": "# First\n\n## Where: it is\n\n**Bold.** words\n", "sub/b.md": "# Second\n"}
PLACES = {"fracture/beam.hpp": "reference/cpp/fracture.md#beamhpp"}


def problems(body):
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "page.html")
        page.write_text(body)
        pathlib.Path(folder, "other.html").write_text('<h1 id="here">Other</h1>')
        (page.parent / "_static/katex").mkdir(parents=True)
        if KATEX.exists():
            shutil.copy(KATEX, page.parent / "_static/katex")
        return check.problems_of(folder)


class Check(unittest.TestCase):
    def test_sound_pages(self):
        self.assertEqual(problems('<a href="other.html#here">x</a><a href="https://a.b/c">y</a><a href="#">z</a>'), [])

    def test_links(self):
        for planted in ('<a href="none.html">', '<a href="other.html#gone">', '<img src="gone.png">', '<a href="#no">'):
            self.assertEqual(len(problems(planted)), 1, planted)

    @unittest.skipUnless(KATEX.exists() and shutil.which("node"), "no KaTeX or no node")
    def test_equations(self):
        self.assertEqual(problems('<div class="tex display">F = \\sigma_c A</div>'), [])
        self.assertEqual(len(problems('<span class="math tex">\\frac{1}</span>')), 1)

    def test_a_command_s_help_becomes_a_page(self):
        page = reference.of_help(HELP, 2)
        self.assertTrue(page.startswith("Cut a thing.\n"))
        self.assertIn("```bash\n# once\npolynya thing a.json\n\npolynya thing a.json --times 3 --slowly\n```", page)
        for row in ("| `--times N` | How often | 1 to 9; 2 if not given |",
                    "| `--angle DEG` | Of the thing | 0 to 89.9; required |",
                    "| `--opposite DEG` | Instead: the other one | 0 to 89.9123 |",
                    "| `--keep inside\\|outside` | Which \\| stays |  |",
                    "| 2 | usage (also: no thing) |", "| 5 | input/output, or no file |"):
            self.assertIn(row + "\n", page)
        self.assertNotIn("--help", page)

    def test_the_dark_colours_are_also_for_dark_systems(self):
        style = '''body[data-theme="dark"] {
 --ink: white; }
body[data-theme="light"] { --ink: black; }
@media not print { body[data-theme="dark"] .a { b: c; } }'''
        self.assertEqual("".join(build.dark_rules(style)),
                         'body[data-theme="auto"] {\n --ink: white; }\nbody[data-theme="auto"] .a { b: c; }\n')

    def test_guides_are_found_before_what_is_for_developers(self):
        order = (SOURCE / "tools/site/search_order.js").read_text()
        named = set(re.findall(r"[\w-]+", re.search(r"\^\(view[^)]*\)", order)[0]))  # in two strings
        self.assertLessEqual(set(pages.PARTS["How to"]), named, "guides that the search does not know")

    def test_mentions_become_links(self):
        def linked(name, text):
            return pages.linked(name, text, TEXTS, PLACES)

        self.assertEqual(linked("sub/b.md", f"see {DOCS}/a.md."), "see [First](../a.md).")
        self.assertEqual(linked("a.md", f"({DOCS}/sub/b.md, x)"), "([Second](sub/b.md), x)")
        self.assertEqual(linked("sub/b.md", f'{DOCS}/a.md,\n"Where"'), '[First, "Where"](../a.md#where-it-is)')
        self.assertEqual(linked("sub/b.md", '[a.md](../a.md), "Bold"'), '[First, "Bold"](../a.md#where-it-is)')
        self.assertEqual(linked("a.md", f"`{DOCS}/sub/b.md`"), f"`{DOCS}/sub/b.md`")
        self.assertEqual(linked("a.md", "`fracture/beam.hpp`"),
                         "[`fracture/beam.hpp`](reference/cpp/fracture.md#beamhpp)")


if __name__ == "__main__":
    unittest.main()
