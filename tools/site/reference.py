"""Pages of the site's reference that are made from the program and the Python package."""
import re
import subprocess

# Module -> the documented names. Without names, all public ones are documented.
PYTHON = {
    "polynya": ["Scene", "Simulation", "Ship", "SeenShip", "PilotView", "Floes", "FloeMemory", "cut", "Cut", "Run",
                "Study", "Problem", "SceneError", "SimulationError", "FolderError", "require"],
    "polynya.environment": [],
    "polynya.statistics": [],
    "polynya.formulas": [],
}


# Guides of commands that no guide's title names.
GUIDES = {"run": "start", "init": "start", "validate": "start", "schema": "scene", "resume": "run-folder",
          "loads": "loads", "management": "management"}


def printed(polynya, *arguments):
    return subprocess.run([polynya, *arguments], capture_output=True, text=True, check=True).stdout


def parts_of_help(text):
    """A help text by its blocks: `meaning`, `usage`, the text under each heading that ends with a colon, and the exit
    codes."""
    parts = {"meaning": [], "rest": []}
    heading = "meaning"
    for line in text.splitlines():
        usage = re.match(r"Usage: (.*)", line)
        codes = re.match(r"Exit codes: (.*)", line)
        title = re.match(r"(\S.*):$", line)
        if usage:
            parts["usage"], heading = [usage[1]], "rest"
        elif codes:
            parts["codes"], heading = [codes[1]], "rest"
        elif title:
            heading = title[1]
            parts[heading] = []
        elif not line.strip():
            heading = "rest" if heading == "meaning" and parts["meaning"] else heading
        elif line.startswith("  ") or heading in ("meaning", "rest"):
            parts[heading].append(line)
        else:
            parts["rest"].append(line)
    return parts


COLUMN = 30  # column in which explanations begin in help texts


def rows_of(lines):
    """Rows of an indented list of a help text: what is explained, and the explanation, which may go on in further lines
    or begin in the next one."""
    rows = []
    for line in lines:
        found = re.match(r" {2}(\S.*?)(?: {2,}(\S.*))?$", line)
        if found:
            rows.append([found[1], found[2] or ""])
        elif rows:
            rows[-1][1] = f"{rows[-1][1]} {line.strip()}".strip()
    return rows


def option_rows(lines):
    """The same of a list of options, whose explanations begin at a column, be it after a single space."""
    spaced = []
    for line, following in zip(lines, [*lines[1:], ""]):
        is_whole = following.startswith(" " * COLUMN)  # its explanation is below
        is_near = not is_whole and re.match(r"  \S", line) and line[COLUMN - 1:COLUMN] == " "
        spaced.append(f"{line[:COLUMN]}  {line[COLUMN:]}" if is_near else line)
    return rows_of(spaced)


def cell(text):
    """Text as a cell of a Markdown table."""
    return re.sub(r"([|<>*_\[\]])", r"\\\1", text)


def option_row(name, meaning):
    """A row of a table: the option with its values, the range, the default and the meaning."""
    is_required = name.endswith("REQUIRED")
    name = name.removesuffix("REQUIRED").strip()
    found = re.match(r"(\S+(?: [^:= ]\S*?)?(?: \.\.\.)?(?: x \d+)?)(?::(.*?))?(?:=(.*))?$", name)
    shown, span, default = found.groups() if found else (name, None, None)
    span = span if span and " to " in span else ""
    words = meaning[:1].upper() + meaning[1:]
    limits = "; ".join(filter(None, [span, default and f"{default} if not given", "required" if is_required else ""]))
    name = shown.replace("|", "\\|")
    return f"| `{name}` | {cell(words)} | {cell(limits)} |"


def examples_of(lines):
    """Lines of examples as a block of shell: what each does stands above it."""
    blocks = []
    for command, words in rows_of(lines):
        blocks.append(f"# {words}\n{command}" if words else command)
    return "```bash\n" + "\n\n".join(blocks) + "\n```\n"


def exit_codes(words):
    codes = re.findall(r"(\d+) ((?:(?!, \d+ ).)+?)(?=,? \d+ |[,.]?$)", words)
    return "| exit code | meaning |\n|---|---|\n" + "".join(f"| {code} | {cell(meaning.rstrip(',. '))} |\n"
                                                          for code, meaning in codes)


def of_help(text, level, guide=""):
    """A command's help as Markdown, its headings at a level."""
    parts = parts_of_help(text)
    marks = "#" * level
    page = " ".join(line.strip() for line in parts["meaning"]) + f".{guide}\n"
    if parts.get("Examples"):
        page += f"\n{marks} Examples\n\n{examples_of(parts['Examples'])}"
    page += f"\n{marks} Usage\n\n```text\n{' '.join(parts.get('usage', []))}\n```\n"
    for heading, lines in parts.items():
        if heading in ("meaning", "rest", "usage", "codes", "Examples", "Subcommands") or not lines:
            continue
        rows = [option_row(*row) for row in option_rows(lines) if not row[0].startswith("-h,")]
        if not rows:
            continue
        page += f"\n{marks} {heading}\n\n| | meaning | values |\n|---|---|---|\n" + "\n".join(rows) + "\n"
    if parts["rest"]:
        page += "\n" + cell("\n".join(parts["rest"])) + "\n"
    if parts.get("codes"):
        page += f"\n{marks} Exit codes\n\n{exit_codes(parts['codes'][0])}"
    return page


def subcommands_of(text):
    return rows_of(parts_of_help(text).get("Subcommands", []))


def guides(texts):
    """Of each command the guide whose title names it: page and title."""
    found = {}
    for page, text in texts.items():
        title = text.split("\n", 1)[0].lstrip("# ")
        for words in re.findall(r"polynya ([\w, ]+)$", title):
            for name in re.split(r",\s*", words):
                found[name.strip()] = (page, title)
    for name, page in GUIDES.items():
        if f"{page}.md" in texts:
            found.setdefault(name, (f"{page}.md", texts[f"{page}.md"].split("\n", 1)[0].lstrip("# ")))
    return found


def commands(polynya, texts):
    """Pages of the commands, from their own help: the list of all, and a page each."""
    whole = printed(polynya, "--help")
    guide_of = guides(texts)
    made = {}
    table = "| command | what it does | guide |\n|---|---|---|\n"
    for name, meaning in subcommands_of(whole):
        help_text = printed(polynya, name, "--help")
        page, title = guide_of.get(name, ("", ""))
        link = f"[{title}](../../{page})" if page else ""
        text = f"# polynya {name}\n\n" + of_help(help_text, 2, f" Guide: {link}." if link else "")
        for inner, _ in subcommands_of(help_text):
            text += f"\n## polynya {name} {inner}\n\n" + of_help(printed(polynya, name, inner, "--help"), 3)
        made[f"reference/commands/{name}.md"] = text
        table += f"| [`polynya {name}`](commands/{name}.md) | {cell(meaning)} | {link.replace('../../', '../')} |\n"
    parts = parts_of_help(whole)
    made["reference/commands.md"] = ("# Commands\n\nEach command has a page, made from its own `--help`. "
                                     "Data goes to stdout, messages to stderr.\n\n" + table
                                     + f"\n## Examples\n\n{examples_of(parts['Examples'])}"
                                     + f"\n## Exit codes\n\n{exit_codes(parts['codes'][0])}")
    return made


def cite(root, version):
    """How to cite, from CITATION.cff."""
    text = (root / "CITATION.cff").read_text()
    title = re.search(r'^title: "(.+)"', text, re.MULTILINE)[1]
    author = re.search(r'- name: "(.+)"', text)[1]
    return f"""# How to cite

Name the version, the commit that `polynya --version` prints, and the hash of each scene that `polynya validate`
prints: whoever has these three has your run to the byte. CITATION.cff in the repository has the same for GitHub and
Zotero.

In text:

> {author}, *{title}*, version {version}.

For BibTeX:

```bibtex
@software{{polynya,
  author  = {{{{{author}}}}},
  title   = {{{{{title}}}}},
  version = {{{version}}},
  license = {{GPL-3.0-or-later}},
  note    = {{commit of `polynya --version`}}
}}

@inproceedings{{sawamura2017,
  author    = {{Sawamura, Junji}},
  title     = {{2D Numerical Modeling of Icebreaker Advancing in Ice-covered Water}},
  booktitle = {{Proceedings of the International Conference on Port and Ocean Engineering under Arctic Conditions}},
  year      = {{2017}},
  note      = {{paper 099}}
}}
```

The second is the paper whose model Polynya implements. Laws that differ from it are named with their sources on the
pages of [theory](theory/index.md); [references](references.md) lists these sources.
"""


def python():
    text = "Python\n======\n\nFrom the package's docstrings; docs/python.md shows how it is used.\n"
    for module, names in PYTHON.items():
        text += f"\n{module}\n{'-' * len(module)}\n\n.. automodule:: {module}\n"
        if not names:
            text += "   :members:\n"
        for name in names:
            kind = "function" if name[0].islower() else "exception" if name.endswith("Error") else "class"
            text += f"\n.. auto{kind}:: {module}.{name}\n" + ("   :members:\n" if kind != "function" else "")
    return text
