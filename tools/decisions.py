"""The index of the decisions in docs/decisions: a dated list, a sentence each. Writes docs/decisions/index.md.

    python3 tools/decisions.py            --check fails where the index is not current, or a decision lacks a section

A decision is DATE-SLUG.md in docs/decisions: a heading, then the sections of SECTIONS in their order. The sentence of
the index is the first of its choice. A line in italics below the heading states what took the decision's place.
"""
import pathlib
import re
import sys
import textwrap

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "docs/decisions"
NAME = re.compile(r"(\d{4}-\d\d-\d\d)-[a-z0-9-]+\.md")
SECTIONS = ["Context", "Choice", "Evidence", "Consequences"]
SENTENCE = re.compile(r".+?[.:](?=\s+[^a-z\s]|\s*$)", re.DOTALL)
HEAD = """# Decisions

What was decided, why, on what evidence, and what it costs. The newest first; a decision that no longer holds says so.
Written by `python3 tools/decisions.py` from the files beside it; the test `decisions` fails where it is not current.
"""


def sections_of(text):
    """Text by section: headings, or words in bold at the beginning of a paragraph."""
    parts = re.split(r"^(?:##+ |\*\*)(%s)\.?(?:\*\*)?\.?" % "|".join(SECTIONS), text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], (part.strip() for part in parts[2::2])))


def entry_of(path):
    """(date, title, line of the index), or a text of what is wrong."""
    name, text = NAME.fullmatch(path.name), path.read_text()
    title = re.match(r"# (.+)\n", text)
    if not name or not title:
        return f"{path.name}: a decision is DATE-SLUG.md and begins with its heading"
    sections = sections_of(text)
    if list(sections) != SECTIONS or not all(sections.values()):
        return f"{path.name}: its sections are {', '.join(sections)}, not {', '.join(SECTIONS)}"
    status = re.search(r"\n\*([^*\n]+)\*\n", text)
    sentence = " ".join(SENTENCE.match(sections["Choice"])[0].split())
    words = f"[{title[1]}]({path.name}). {sentence}" + (f" *{status[1]}*" if status else "")
    return name[1], title[1], textwrap.fill(words, 118, initial_indent="- ", subsequent_indent="  ",
                                            break_long_words=False, break_on_hyphens=False) + "\n"


def main(*options):
    entries = [entry_of(path) for path in sorted(FOLDER.glob("*.md")) if path.name != "index.md"]
    problems = [entry for entry in entries if isinstance(entry, str)]
    text, date = HEAD, ""
    if not problems:
        by_title = sorted(entries, key=lambda entry: entry[1])
        for when, _, line in sorted(by_title, key=lambda entry: entry[0], reverse=True):
            text += f"\n## {when}\n" if when != date else ""
            text, date = text + line, when
        index = FOLDER / "index.md"
        if "--check" not in options:
            index.write_text(text)
        elif not index.exists() or index.read_text() != text:
            problems.append("docs/decisions/index.md is not current: python3 tools/decisions.py")
    print("\n".join(problems) or f"{len(entries)} decisions, each with its sections and in the index")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
