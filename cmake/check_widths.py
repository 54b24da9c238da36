"""Fails on a line of more than 120 characters, in every text of the repository that people write.

    python3 cmake/check_widths.py SOURCE

Tables and blocks of code and output in Markdown may be wider, rows of the tests' tables, and strings that cannot be
broken: those of JSON.
"""
import os
import pathlib
import re
import sys

MOST_COLUMNS = 120
SKIPPED_FOLDERS = {".git", "build", "node_modules", "__pycache__", "runs", "vendor", "images"}
STUDIES_KEPT = {"benches", "scenes"}  # kept folders of studies/, where `polynya study` makes folders, too
# Data files that are written by programs or kept unchanged.
DATA = re.compile(r"\.(csv|geojson|svg|png|gif|ico)$|_corpus/|^tests/geometry/.*\.txt$|^tests/passing/.*\.json$|"
                  r"^tests/mutation/.*\.ndjson$|^fracture/bending/default_database\.txt$|"
                  r"^tests/view/package-lock\.json$|^LICENSE$")
JSON_STRING = re.compile(r'\s*"\w+": "[^"]*",?$')


def texts(root):
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(set(folders) - SKIPPED_FOLDERS)
        if pathlib.Path(folder) == pathlib.Path(root, "studies"):
            folders[:] = [kept for kept in folders if kept in STUDIES_KEPT]
        for name in sorted(files):
            path = pathlib.Path(folder, name).relative_to(root).as_posix()
            if DATA.search(path):
                continue
            try:
                yield path, pathlib.Path(folder, name).read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue


def problems_of(path, text):
    is_fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        is_fenced ^= path.endswith(".md") and line.lstrip().startswith("```")
        is_free = path.endswith(".md") and (is_fenced or line.startswith(("|", "    ")))
        is_free |= path.startswith("tests/") and path.endswith(".txt") and " | " in line
        is_free |= path.endswith(".json") and JSON_STRING.match(line) is not None
        if len(line) > MOST_COLUMNS and not is_free:
            yield f"{path}:{number}: {len(line)} columns, more than {MOST_COLUMNS}"


def main(root):
    found, files = [], 0
    for path, text in texts(root):
        files += 1
        found.extend(problems_of(path, text))
    print("\n".join(found) or f"{files} texts of at most {MOST_COLUMNS} columns")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
