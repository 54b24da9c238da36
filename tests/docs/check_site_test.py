"""The check of the site itself: what is planted is found, and sound pages have nothing.

    python3 tests/docs/check_site_test.py SOURCE
"""
import pathlib
import shutil
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else ".")
sys.path.insert(0, str(SOURCE / "tools/site"))
import check  # noqa: E402
import pages  # noqa: E402

KATEX = pathlib.Path("/usr/share/javascript/katex/katex.min.js")
DOCS = "docs"  # the pages below are of no file
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
