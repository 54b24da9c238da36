"""The site's navigation, and what turns the pages of docs/ into its sources."""
import os
import re

# Caption -> pages in their order. A page of docs/ that no part names is an error.
PARTS = {
    "Start": ["browser", "start", "tutorial", "gallery", "cite"],
    "How to": ["view", "figures", "loads", "movie", "channel", "brash", "inspect", "why-it-split", "export", "ships",
               "management", "import", "cut", "database", "studies", "python", "environment",
               "couple"],
    "Reference": ["glossary", "scene", "run-folder", "reference/commands", "reference/python", "reference/cpp",
                  "references"],
    "Theory": ["theory/index", "geometry"],
    "Validation": ["validation", "paper-comparison"],
    "Performance": ["performance"],
    "Reliability": ["reliability"],
    "Developers": ["architecture", "change-a-law", "contributing", "decisions/index", "changelog"],
}

FENCE = re.compile(r"(^```.*?^```$|`[^`]+`|^ {4}.*$)", re.MULTILINE | re.DOTALL)
QUOTED = r'(?:(,\s+)"([^"]+)")?'
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([\w./-]+\.md)(#[\w-]+)?\)" + QUOTED)
KEY = re.compile(r"\[([A-Z][A-Za-z]+\d{4}[a-z]?)\](?!\()")
MENTION = re.compile(r"(?<![\w/\[])(?<!\]\()docs/([\w./-]+\.md)" + QUOTED)


def title_of(text):
    return re.match(r"#+ (.+)", text)[1].replace("`", "")


def anchor_of(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def heading_named(text, name):
    """The heading that a page names in quotes, or that stands over the words in bold that it names."""
    found = None
    for line in text.splitlines():
        heading = re.match(r"#+ (.+)", line)
        found = heading[1] if heading else found
        if found and (re.split(":", found)[0] == name or found == name or line.lstrip("- ").startswith(f"**{name}")):
            return found
    return None


def linked(name, text, pages, places):
    """The text of page `name` with each page that it mentions as a link, to the section that it names; and each public
    header as a link to its place in the reference."""
    here = os.path.dirname(name)

    def link(page, comma, section, words, anchor):
        if page not in pages:
            return None
        heading = heading_named(pages[page], section) if section else None
        anchor = anchor or (f"#{anchor_of(heading)}" if heading else "")
        if not words or words.endswith(".md"):
            words = title_of(pages[page])
        quoted = f'{comma}"{section}"' if section else ""
        return f"[{words}{' '.join(quoted.split()) if quoted else ''}]({os.path.relpath(page, here or '.')}{anchor})"

    def of_link(match):
        words, target, anchor, comma, section = match.groups()
        page = os.path.normpath(os.path.join(here, target))
        return link(page, comma, section, words, anchor) or match[0]

    def of_mention(match):
        page, comma, section = match.groups()
        return link(page, comma, section, "", "") or match[0]

    def of_code(code):
        place = places.get(code.strip("`"))
        return f"[{code}]({os.path.relpath(place, here or '.')})" if place else code

    def of_key(match):
        return f"[\\[{match[1]}\\]]({os.path.relpath('references.md', here or '.')})"

    parts = FENCE.split(text)
    # Quoted sections may be in the next line, but never across code.
    return "".join(of_code(part) if k % 2 else KEY.sub(of_key, MENTION.sub(of_mention, LINK.sub(of_link, part)))
                   for k, part in enumerate(parts))


def toctree(entries, caption="", **options):
    lines = ["```{toctree}", *([f":caption: {caption}"] if caption else [])]
    lines += [f":{key}: {value}".rstrip() for key, value in options.items()]
    return "\n".join([*lines, *entries, "```", ""])
