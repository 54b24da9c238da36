#!/usr/bin/python3
"""Builds the site of the documentation, for any browser, from disk, offline: build/site/html/index.html.

    tools/site/build.py [--build TREE] [--out FOLDER]       ./setup.sh site installs what it needs

TREE is a build tree with the program and the Python module (build/release, else build/dev): commands and Python come
from them. Every warning of Sphinx is an error; then every link, anchor and picture of the pages is checked, and every
equation, by KaTeX, where node is.
"""
import argparse
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys

import check
import cpp
import pages
import reference

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KATEX = pathlib.Path("/usr/share/javascript/katex")
NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
SKIPPED = 77


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:  # Sphinx reads changed files again
        path.write_text(text)


def texts_of_pages():
    texts = {str(p.relative_to(ROOT / "docs")): p.read_text() for p in sorted((ROOT / "docs").rglob("*.md"))}
    texts["contributing.md"] = (ROOT / "CONTRIBUTING.md").read_text()
    texts["changelog.md"] = (ROOT / "CHANGELOG.md").read_text()
    return texts


def children_of(name, texts, made):
    """Pages below a part's page: of decisions and theory, and of the reference what is made."""
    folder = os.path.dirname(name)
    is_made = name in ("reference/cpp", "reference/commands")
    if not name.endswith("/index") and not is_made:
        return []
    below = f"{name}/" if is_made else f"{folder}/"
    found = sorted(page.rsplit(".", 1)[0] for page in [*texts, *made] if page.startswith(below))
    text = texts.get(f"{name}.md", "") or made.get(f"{name}.md", "")  # in the order in which it links to them
    return sorted((page for page in found if page != name),
                  key=lambda page: text.find(f"({page[len(folder) + 1:]}.md)"))


def write_sources(source, polynya, version):
    texts = texts_of_pages()
    headers, places = cpp.pages(ROOT, source.parent / "doxygen")
    made = {**reference.commands(polynya, texts), "reference/python.rst": reference.python(), **headers}
    made["reference/cpp.md"] = "# C++\n\nThe public headers, by room and folder, from their comments (Doxygen).\n"
    made["cite.md"] = reference.cite(ROOT, version)
    index, listed = (ROOT / "tools/site/index.md").read_text(), set()
    for caption, names in pages.PARTS.items():
        index += "\n" + pages.toctree([f"/{name}" for name in names], caption, hidden="", maxdepth=2)
        for name in names:
            below = children_of(name, texts, made)
            listed |= {name, *below}
            if below:
                holder = made if f"{name}.md" in made else texts
                tree = pages.toctree([f"/{page}" for page in below], maxdepth=1,
                                     **({"hidden": ""} if holder is texts else {}))
                holder[f"{name}.md"] += "\n" + tree
    unlisted = sorted(page for page in texts if page[:-3] not in listed)
    if unlisted:
        sys.exit(f"tools/site/pages.py: in no part of the site: {', '.join(unlisted)}")
    live = ROOT / "build/browser/polynya.html"  # the page that holds the simulator, where it is built
    if live.exists():
        title, rest = texts["browser.md"].split("\n", 1)
        texts["browser.md"] = f'{title}\n\n<a href="_static/try.html"><b>Try it</b>: open the page</a>\n{rest}'
    for name, text in {**texts, "index.md": index}.items():
        write(source / name, pages.linked(name, text, texts, places))
    for name, text in made.items():
        write(source / name, text)
    for old in source.rglob("*"):
        name = str(old.relative_to(source))
        if old.suffix in {".md", ".rst"} and name != "index.md" and name not in texts and name not in made:
            old.unlink()
    shutil.copytree(ROOT / "docs/images", source / "images", dirs_exist_ok=True)
    shutil.copytree(ROOT / "tools/site/static", source / "static", dirs_exist_ok=True)
    if live.exists():
        (source / "static").mkdir(parents=True, exist_ok=True)
        shutil.copy(live, source / "static/try.html")
    shutil.copytree(KATEX, source / "static/katex", dirs_exist_ok=True,
                    ignore=shutil.ignore_patterns("contrib", "*.mjs"))


def bundle_theme(static):
    """Debian's furo has a script that imports another, which no browser does from disk, a style from its server, and
    its dark colours only for readers who chose them, not for systems that are dark."""
    script, gumshoe = static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    text = script.read_text()
    if text.startswith("import Gumshoe"):  # the other is UMD: as a classic script it defines window.Gumshoe
        script.write_text(gumshoe.read_text() + text.split("\n", 1)[1])
    style = static / "styles/furo.css"
    text = style.read_text().replace("@import url(/javascript/normalize.css/normalize.css);", NORMALIZE.read_text())
    style.write_text(text + "".join(f"@media screen and (prefers-color-scheme: dark) {{\n{rule}}}\n"
                                    for rule in dark_rules(text)))


def dark_rules(style):
    """The rules of a style sheet for the theme "dark", for the theme that follows the system."""
    rules = re.findall(r"[^{}]*\[data-theme=\"?dark\"?\][^{}]*\{[^{}]*\}", style)
    rules = [rule for rule in rules if "theme-icon" not in rule]  # which icon shows is of the choice, not of the system
    return [rule.strip().replace('[data-theme="dark"]', '[data-theme="auto"]') + "\n" for rule in rules]


def tree_of(options):
    for tree in [options.build] if options.build else [ROOT / "build/release", ROOT / "build/dev"]:
        if (tree / "app/polynya").exists():
            return tree.resolve()
    sys.exit("site: no program in a build tree: ./quickstart, or --build TREE")


def missing():
    needed = ("sphinx", "furo", "myst_parser", "sphinx_copybutton", "numpy")
    modules = [name for name in needed if not importlib.util.find_spec(name)]
    return modules + [name for name, there in (("doxygen", shutil.which("doxygen")), ("KaTeX", KATEX.exists()),
                                       ("normalize.css", NORMALIZE.exists())) if not there]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, help="the build tree")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/site", help="where to build")
    options = parser.parse_args()
    if missing():
        print(f"skipped: {sys.executable} has no {', '.join(missing())} (./setup.sh site)")
        return SKIPPED
    tree, out = tree_of(options), options.out.resolve()
    version = reference.printed(str(tree / "app/polynya"), "--version").split()[1]
    write_sources(out / "source", str(tree / "app/polynya"), version)
    environment = {**os.environ, "POLYNYA_VERSION": version, "POLYNYA_PYTHON": str(tree / "python"),
                   "POLYNYA_STATIC": str(out / "source/static")}
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-c", str(ROOT / "tools/site"),
               "-d", str(out / "read"), str(out / "source"), str(out / "html")]
    if subprocess.run(command, env=environment, check=False).returncode != 0:
        return 1
    bundle_theme(out / "html/_static")
    problems = check.problems_of(out / "html")
    print("\n".join(problems) or f"the site: {out / 'html/index.html'}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
