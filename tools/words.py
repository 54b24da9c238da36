"""Counts the words of the documentation, page by page, without its generated reference.

    python3 tools/words.py [--all]            --check fails above MOST_WORDS

Counted are README.md, CONTRIBUTING.md, CHANGELOG.md and the Markdown below docs/, with their tables, commands and
output. A word is what stands between blanks and has a letter or a digit: a number in a table is one, its bars are none.
Generated, and so not counted: docs/decisions/index.md; tables of docs/scene.md and docs/run-folder.md that tests hold
to the source's own words (GENERATED_TABLES); and what programs write between markers of a page (MARKED). With --all
those between markers are counted too.
"""
import pathlib
import re
import sys

MOST_WORDS = 60000
ROOT = pathlib.Path(__file__).resolve().parent.parent
GENERATED_PAGES = {"docs/decisions/index.md"}
# Of `polynya schema --markdown`; of the columns and fields in io/run.
GENERATED_TABLES = {"docs/scene.md": {"| key | allowed | default | meaning |"},
                    "docs/run-folder.md": {"| column | of the steps of the interval | what |", "| column | what |",
                                           "| field | of | what |"}}
# Of bench/put_tables.py, tools/paper_comparison.py and tools/course_table.py.
MARKED = re.compile(r"<!-- (\w+)(?:: begin)? -->\n.*?<!-- (?:/\1|\1: end) -->", re.DOTALL)
TABLE = re.compile(r"^\|.*\n(?:\|.*\n)*", re.MULTILINE)


def written_by_hand(name, text, is_all=False):
    """The text without what programs write."""
    text = text if is_all else MARKED.sub("", text)
    generated = GENERATED_TABLES.get(name, set())
    return TABLE.sub(lambda table: "" if table[0].split("\n")[0] in generated else table[0], text)


def words_of(text):
    return sum(re.search(r"\w", word) is not None for word in text.split())


def pages(root):
    yield from (root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"))
    yield from sorted((root / "docs").rglob("*.md"))


def main(*options):
    counts = {}
    for path in pages(ROOT):
        name = path.relative_to(ROOT).as_posix()
        if name not in GENERATED_PAGES:
            counts[name] = words_of(written_by_hand(name, path.read_text(), "--all" in options))
    total = sum(counts.values())
    if "--check" not in options:
        for name, count in sorted(counts.items(), key=lambda item: -item[1]):
            print(f"{count:6}  {name}")
    print(f"{total} words in {len(counts)} pages, at most {MOST_WORDS}")
    return 1 if "--check" in options and total > MOST_WORDS else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
