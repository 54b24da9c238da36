"""Fails where a page names what does not exist: links, their anchors, pictures, scenes, run folders that no command
makes, references; and where a source names a page that does not exist.

    python3 tests/docs/check_docs.py SOURCE POLYNYA
"""
import json
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
SCENE = re.compile(r"\bscenes/[\w.-]+\.json")
RUN = re.compile(r"\bruns/([\w.-]*\w)")
KEY = re.compile(r"\[([A-Z][A-Za-z]+\d{4}[a-z]?)\]")
PAGE = re.compile(r"\bdocs/[\w./-]+\.(?:md|svg|png)\b")
SECTION = re.compile(r'\b(docs/[\w./-]+\.md),\s+"([^"]+)"')
VALIDATED = re.compile(r"^\$ polynya validate (scenes/\S+)\n((?:.+\n)+?)(?:```|\$)", re.MULTILINE)


def scene_name(path):
    text = re.sub(r"(?m)(^|\s)//.*$", "", path.read_text())
    return json.loads(text)["name"]


def runs_made(root, text):
    """Names below runs/ that a command in this text writes."""
    made = set(re.findall(r"--out runs/([\w.-]*\w)", text))
    for scene in re.findall(r"polynya run (scenes/[\w.-]+\.json)(?! --out)", text):
        if (root / scene).exists():
            made.add(scene_name(root / scene))
    return made


def headings_of(text):
    text = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    return [heading.strip() for heading in re.findall(r"^#+ (.+)", text, re.MULTILINE)]


def sections_of(text):
    """What a page names as its sections: headings, and words in bold that begin a paragraph or an item."""
    bold = re.findall(r"^(?:- )?\*\*([^*]+?)[.:]?\*\*", text, re.MULTILINE)
    whole = {" ".join(name.split()) for name in headings_of(text) + bold}
    return whole | {name.split(":")[0] for name in whole}


def anchors_of(text):
    """As GitHub and the site (MyST) make them of headings."""
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings_of(text)}


def problems_of_mentions(root, text):
    """Pages that are named in words, in pages and in sources."""
    for path in PAGE.findall(text):
        if not (root / path).exists():
            yield f"{path} does not exist"
    for path, section in SECTION.findall(re.sub(r"\n\W*", " ", text)):
        if (root / path).exists() and section not in sections_of((root / path).read_text()):
            yield f'{path} has no section "{section}"'


def problems_of_page(root, page, text, keys):
    runs = runs_made(root, text) | runs_made(root, (root / "quickstart").read_text())
    for target in LINK.findall(re.sub(r"`[^`\n]*`", "", text)):
        path, _, anchor = target.partition("#")
        file = page.parent / path if path else page
        if "://" in target:
            continue
        if not file.exists():
            yield f"link to {target}, which does not exist"
        elif anchor and anchor not in anchors_of(file.read_text()):
            yield f"link to {target}: no such heading"
    for scene in SCENE.findall(text):
        if not (root / scene).exists():
            yield f"{scene} does not exist"
    for run in RUN.findall(text):
        if run not in runs:
            yield f"runs/{run}: neither ./quickstart nor a command on this page makes it"
    for key in KEY.findall(text):
        if key not in keys:
            yield f"[{key}] is not in docs/references.md"


def is_shown(printed, shown):
    """An ellipsis on the page stands for anything."""
    return re.fullmatch(re.escape(shown.strip()).replace("…", ".*"), printed.strip()) is not None


def problems_of_output(root, polynya, text):
    """What `polynya validate` prints of a shipped scene is on the page as it is printed today."""
    for scene, shown in VALIDATED.findall(text):
        run = subprocess.run([polynya, "validate", scene], cwd=root, capture_output=True, text=True, check=False)
        if not is_shown(run.stdout, shown):
            yield f"`polynya validate {scene}` prints\n{run.stdout}and not\n{shown}"


def problems_of_example(root):
    """The example of docs/architecture.md is what tests/consumer compiles and runs."""
    example = re.search(r"// begin\n(.*?)// end\n", (root / "tests/consumer/main.cpp").read_text(), re.DOTALL)
    if not example or f"```cpp\n{example[1]}```" not in (root / "docs/architecture.md").read_text():
        yield "docs/architecture.md: its example of a run is not the one in tests/consumer/main.cpp"


def sources(root):
    folders = "geometry dynamics fracture simulation io analysis views cosim app bench scenes python tests tools cmake"
    for folder in [*folders.split(), "examples"]:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".cpp", ".hpp", ".js", ".json", ".py", ".txt"} and "vendor" not in path.parts:
                yield path


def main(root, polynya):
    pages = {path: path.read_text() for path in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]}
    keys = set(re.findall(r"^\| (\w+) \|", (root / "docs/references.md").read_text(), re.MULTILINE))
    found = []
    for page, text in pages.items():
        for problem in problems_of_page(root, page, text, keys):
            found.append(f"{page.relative_to(root)}: {problem}")
        for problem in [*problems_of_output(root, polynya, text), *problems_of_mentions(root, text)]:
            found.append(f"{page.relative_to(root)}: {problem}")
    found.extend(problems_of_example(root))
    for path in sources(root):
        text = path.read_text(errors="replace")
        for key in KEY.findall(text):
            if key not in keys:
                found.append(f"{path.relative_to(root)}: [{key}] is not in docs/references.md")
        for problem in problems_of_mentions(root, text):
            found.append(f"{path.relative_to(root)}: {problem}")
    print("\n".join(found) or f"{len(pages)} pages, every link, scene, run and reference resolves")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]))
