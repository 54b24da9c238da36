"""Fails where a page or a comment names a file or a folder of the repository that does not exist.

    python3 tests/docs/check_paths.py SOURCE

A path begins with a folder of the repository (`io/run/records.cpp`, `docs/theory`), may have {a,b} and *, and stands
for any name where it has a word in capitals (`python/polynya/NAME`). A file of source or a page may be named by the end
of its path (`records.cpp`). CHANGELOG.md is history: it may name what is gone.
"""
import fnmatch
import os
import pathlib
import re
import subprocess
import sys

NOT_READ = ("docs/images/", "views/player/vendor/", "tests/docs/check_paths_test.py", "tests/docs/check_site_test.py",
            "tools/site/index.md")  # the last names pages that the site's build makes
COMMENTS = {  # suffix -> parts of a source that a person reads
    ".cpp": r"//[^\n]*|/\*.*?\*/", ".hpp": r"//[^\n]*|/\*.*?\*/", ".js": r"//[^\n]*|/\*.*?\*/",
    ".py": r'#[^\n]*|"""(?!\\).*?"""', ".txt": r"#[^\n]*", ".cmake": r"#[^\n]*", ".sh": r"#[^\n]*", "": r"#[^\n]*"}
OF_SOURCE = r"cpp|hpp|py|js|cmake|sh|md"
NAME = re.compile(rf"(?<![\w./-])([\w-]+(?:/[\w-]+)*\.(?:{OF_SOURCE}))\b(?![(/])")
PROGRAMS = {"gdal_polygonize.py"}  # programs of other packages
MADE = "studies"  # `polynya study` makes folders there, too: of this one only sources and pages are looked for
ELSEWHERE = ("tl/", "boost/", "nlohmann/", "CLI/", "fmt/", "CGAL/", "polynya/")  # headers of libraries


def listed(root):
    """The files of the repository, or of a copy of it without git."""
    git = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=root,
                         capture_output=True, text=True, check=False)
    if git.returncode == 0:
        return [name for name in git.stdout.splitlines() if (root / name).is_file()]
    return [os.path.relpath(os.path.join(folder, name), root) for folder, _, names in os.walk(root)
            for name in names if not os.path.relpath(folder, root).startswith("build")]


def alternatives(path):
    """a/{b,c}.hpp: both paths."""
    braces = re.search(r"\{([^{}]*)\}", path)
    if not braces:
        return [path]
    return [whole for one in braces[1].split(",")
            for whole in alternatives(path[:braces.start()] + one + path[braces.end():])]


class Tree:
    """The files of a repository, and what stands for one of them."""

    def __init__(self, files):
        folders = {str(parent) for name in files for parent in pathlib.PurePosixPath(name).parents}
        self.known = set(files) | folders - {"."}
        self.ends = {"/" + name for name in files}
        tops = "|".join(sorted({re.escape(name.split("/")[0]) for name in files if "/" in name} - {MADE}))
        self.path = re.compile(rf"(?<![\w./-])((?:{tops})/[\w./{{}},*-]*[\w}}*])")

    def has(self, path):
        pattern = re.sub(r"(?<![A-Za-z])[A-Z]{2,}(?![A-Za-z])", "*", path)
        if path.rstrip("/.") in self.known:
            return True
        return "*" in pattern and any(fnmatch.fnmatch(known, pattern) for known in self.known)

    def has_end(self, name):
        return self.has(name) or any(end.endswith("/" + name) for end in self.ends)

    def missing(self, text):
        """The paths in a text that are not there."""
        for named in self.path.findall(text):
            yield from (path for path in alternatives(named) if not self.has(path))
        made = re.findall(r"^```\w+ (\S+)$", text, re.MULTILINE)  # blocks that a page says to save as a file
        for name in NAME.findall(text):
            if name in made or name in PROGRAMS or name.startswith(ELSEWHERE):
                continue
            if not self.has_end(name):
                yield name


def read_by_people(name, text):
    """All of a page, the comments of a source; nothing of other files."""
    suffix = pathlib.PurePosixPath(name).suffix
    if suffix == ".md":
        return text
    if suffix not in COMMENTS or (not suffix and not text.startswith("#!")):
        return ""
    return "\n".join(re.findall(COMMENTS[suffix], text, re.DOTALL))


def main(root):
    files = listed(root)
    tree, found, read = Tree(files), [], 0
    for name in files:
        if name == "CHANGELOG.md" or name.startswith(NOT_READ):
            continue
        try:
            text = read_by_people(name, (root / name).read_text(encoding="utf-8"))
        except UnicodeDecodeError:
            continue
        read += bool(text)
        found += sorted({f"{name}: {path} does not exist" for path in tree.missing(text)})
    print("\n".join(found) or f"{read} pages and sources, every path that they name exists")
    return 1 if found or not read else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
