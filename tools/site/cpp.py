"""The C++ reference: a page of each folder of public headers, from the comments in them, by Doxygen's XML."""
import os
import pathlib
import re
import subprocess
import xml.etree.ElementTree as ElementTree

ROOMS = ["geometry", "dynamics", "fracture", "simulation", "io", "analysis", "views"]
DOXYFILE = """
INPUT = {rooms}
FILE_PATTERNS = *.hpp
RECURSIVE = YES
EXCLUDE_PATTERNS = */internal/* */vendor/*
STRIP_FROM_PATH = {root}
OUTPUT_DIRECTORY = {out}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
EXTRACT_ALL = YES
QUIET = YES
WARNINGS = NO
"""
SHOWN = {"public", ""}


def run_doxygen(root, out):
    os.makedirs(out, exist_ok=True)
    file = out / "Doxyfile"
    file.write_text(DOXYFILE.format(rooms=" ".join(str(root / room) for room in ROOMS), root=root, out=out))
    subprocess.run(["doxygen", file], check=True)


def text_of(element):
    """A description as Markdown: code stays code, everything else is text."""
    if element is None:
        return ""
    words = re.sub(r"([\\*_<>\[\]$|])", r"\\\1", element.text or "") if element.tag != "computeroutput" else \
        f"`{''.join(element.itertext())}`"
    if element.tag == "computeroutput":
        return words
    for child in element:
        words += text_of(child) + re.sub(r"([\\*_<>\[\]$|])", r"\\\1", child.tail or "")
        words += " " if child.tag in {"para", "listitem", "simplesect"} else ""
    return words


def described(element):
    parts = (text_of(element.find(f"{kind}description")) for kind in ("brief", "detailed"))
    return " ".join(" ".join(parts).split())


def plain(element):
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def declared(member):
    """A member as its header has it, without the names of what it lies in."""
    kind, name = member.get("kind"), plain(member.find("name"))
    if kind == "enum":
        return f"enum {name} {{ {', '.join(plain(value.find('name')) for value in member.findall('enumvalue'))} }}"
    qualified = plain(member.find("qualifiedname"))
    words = plain(member.find("definition")).replace(qualified, name) if qualified else plain(member.find("definition"))
    words += plain(member.find("argsstring"))
    start = plain(member.find("initializer"))
    return words + (f" {start}" if start and len(start) < 40 else "")


def item(member):
    meaning = described(member)
    text = f"- `{declared(member)}`" + (f"\n  {meaning}" if meaning else "") + "\n"
    for value in member.findall("enumvalue"):
        if described(value):
            text += f"  - `{plain(value.find('name'))}`: {described(value)}\n"
    return text


def line_of(element):
    return int(element.find("location").get("line", "0"))


def collected(xml):
    """By header: (line, compound or free member) of what stands in it."""
    found = {}
    for path in sorted(xml.glob("*.xml")):
        for compound in ElementTree.parse(path).getroot().iter("compounddef"):
            kind = compound.get("kind")
            elements = [compound] if kind in {"class", "struct"} else []
            if kind == "namespace":
                elements = [m for m in compound.iter("memberdef") if m.get("prot", "") in SHOWN]
            for element in elements:
                place = element.find("location")
                found.setdefault(place.get("declfile") or place.get("file"), []).append(element)
    return found


def section(element):
    """A class with its public members, or a free function, constant or type."""
    if element.tag == "memberdef":
        return item(element)
    name = plain(element.find("compoundname")).split("polynya::")[-1]
    members = [m for m in element.iter("memberdef") if m.get("prot") == "public" and m.get("kind") != "friend"]
    members = [m for m in members if described(m) or m.get("kind") != "function"
               or "operator" not in plain(m.find("name"))]
    meaning = described(element)
    return f"\n### {element.get('kind')} `{name}`\n\n" + (f"{meaning}\n\n" if meaning
                                                          else "") + "".join(map(item, members))


def page_of(folder, headers):
    text = f"# {folder}/\n"
    for header in sorted(headers):
        elements = sorted(headers[header], key=line_of)
        text += f"\n## `{pathlib.Path(header).name}`\n\n"
        free = [e for e in elements if e.tag == "memberdef"]
        text += "".join(map(section, free)) + "".join(section(e) for e in elements if e not in free)
    return text


def pages(root, out):
    """Pages by name, and where each header is: (page, anchor)."""
    run_doxygen(root, out)
    folders, places = {}, {}
    for header, elements in collected(out / "xml").items():
        folders.setdefault(str(pathlib.Path(header).parent), {})[header] = elements
    made = {}
    for folder, headers in folders.items():
        name = f"reference/cpp/{folder.replace('/', '-')}.md"
        made[name] = page_of(folder, headers)
        for header in headers:
            places[header] = f"{name}#{re.sub('[^a-z0-9_-]', '', pathlib.Path(header).name.lower())}"
    return made, places
