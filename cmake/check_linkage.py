"""Fails where two sources of a room give one name to different things without linkage.

    python3 cmake/check_linkage.py SOURCE

A room is compiled several sources at a time (POLYNYA_UNITY), and which sources share a compilation changes when a
source is added. Names in an unnamed namespace, and constants and static functions of a source, are then those of all
sources of the compilation: two of them with one name do not compile, or mean the wrong thing. Functions that differ in
their parameters may share a name.
"""
import collections
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_sizes  # noqa: E402

ROOMS = [room for room in check_sizes.ROOMS if room != "python"]
TYPE = re.compile(r"^(?:template\s*<.*?>\s*)?(?:struct|class|enum(?:\s+class)?|union)\s+(\w+)", re.S)
ALIAS = re.compile(r"^(?:template\s*<.*?>\s*)?using\s+(\w+)\s*=\s*(.*)", re.S)
VARIABLE = re.compile(
    r"^(?:(?:inline|static|constexpr|constinit|thread_local|const)\s+)+[\w:<>,\s*&]*?\b(\w+)\s*(?:\[.*)?$", re.S)
FUNCTION = re.compile(r"([\w~]+)\s*$")
NAMESPACE = re.compile(r"^(?:inline\s+)?namespace\b\s*([\w:]*)\s*$")


def parameters_of(text):
    """The types of parameters, as far as a text shows them: without names and default values."""
    parts, depth, part = [], 0, ""
    for character in text + ",":
        depth += {"<": 1, "(": 1, "[": 1, "{": 1, ">": -1, ")": -1, "]": -1, "}": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += character
    parts = [re.sub(r"\s+", " ", part.split("=")[0]).strip() for part in parts]
    return tuple(re.sub(r"(?<=[\s&*>])\w+$", "", part).strip() for part in parts if part)


def statements_of(code):
    """(text before, what opens or ends it, place, namespaces) of all that stands in namespaces: not within bodies."""
    stack, start, at = [], 0, 0
    while at < len(code):
        character = code[at]
        if character == "(":  # parameters, and what may be in them
            depth = 0
            while at < len(code):
                depth += {"(": 1, ")": -1}.get(code[at], 0)
                at += 1
                if depth == 0:
                    break
            continue
        if character == ";":
            yield code[start:at].strip(), ";", at, tuple(stack)
            start = at + 1
        elif character == "{":
            text = code[start:at].strip()
            namespace = NAMESPACE.match(text)
            if namespace:
                stack.append(namespace[1])
            else:
                yield text, "{", at, tuple(stack)
                depth = 0
                while at < len(code):
                    depth += {"{": 1, "}": -1}.get(code[at], 0)
                    if depth == 0:
                        break
                    at += 1
            start = at + 1
        elif character == "}":
            stack = stack[:-1]
            start = at + 1
        at += 1


def declared_by(text, end):
    """(kind, name, parameters) of what a statement declares, or nothing."""
    text = re.sub(r"\[\[.*?\]\]", "", text).strip()
    for kind, pattern in (("alias", ALIAS), ("type", TYPE)):
        found = pattern.match(text)
        if found:
            return kind, found[1], " ".join(found[2].split()) if kind == "alias" else None
    head = text.split("=")[0] if "operator" not in text else text
    opened = head.find("(")
    if opened >= 0 and (end == "{" or "=" not in text):
        name = FUNCTION.search(head[:opened])
        if name and "::" not in head[:opened].split()[-1] and "operator" not in head[:opened]:
            return "function", name[1], parameters_of(head[opened + 1:head.rfind(")")])
        return None
    found = VARIABLE.match(head.strip())
    return ("variable", found[1], None) if found else None


def names_of(text):
    """{(namespaces, name): {(kind, parameters)}} of the names without linkage in a source, with their lines."""
    code = check_sizes.bare("a.cpp", text)
    code = re.sub(r"^[ \t]*#[^\n]*(?:\\\n[^\n]*)*", lambda match: check_sizes.blank(match.group()), code, flags=re.M)
    for statement, end, at, stack in statements_of(code):
        declared = declared_by(statement, end)
        if not declared:
            continue
        kind, name, parameters = declared
        is_unnamed = "" in stack
        is_internal = is_unnamed or kind == "variable" or (kind == "function" and statement.startswith("static "))
        if is_internal:
            yield tuple(part for part in stack if part), name, kind, parameters, code.count("\n", 0, at) + 1


def clashes_in(sources):
    """Of {path: text}, the sources of a room."""
    known = collections.defaultdict(list)
    for path, text in sources.items():
        for namespaces, name, kind, parameters, line in names_of(text):
            known["::".join(namespaces), name].append((path, line, kind, parameters))
    for (_, name), places in sorted(known.items()):
        for i, (path, line, kind, parameters) in enumerate(places):
            others = [other for other in places[:i] if other[0] != path and not (
                kind == other[2] and kind in ("function", "alias") and
                (parameters != other[3] if kind == "function" else parameters == other[3]))]
            if others:
                yield f"{path}:{line}: {name} stands in {others[0][0]}:{others[0][1]} too"


CONSTANT = re.compile(r"\bconstexpr\b[^;={]*?\b(k[A-Z]\w*)\s*(?:\[[^]]*\])?\s*[={]")


def hidden_in(sources):
    """Constants of functions that hide a constant of another source of the room: -Wshadow warns of them in a batch."""
    of_source = {path: {(".".join(part for part in namespaces), name) for namespaces, name, kind, _, _ in names_of(text)
                        if kind == "variable"} for path, text in sources.items()}
    for path, text in sources.items():
        own = {name for _, name in of_source[path]}
        local = set(CONSTANT.findall(check_sizes.bare(path, text))) - own
        for other, names in of_source.items():
            for name in sorted(local & {name for _, name in names} if other != path else ()):
                yield f"{path}: {name} of a function hides that of {other}"


def rooms_of(root):
    for room in ROOMS:
        yield {path.relative_to(root).as_posix(): path.read_text() for path in sorted((root / room).rglob("*.cpp"))}
    for folder in sorted((root / "tests").iterdir()):
        if folder.is_dir() and folder.name not in ("fuzz", "consumer"):
            yield {path.relative_to(root).as_posix(): path.read_text() for path in sorted(folder.rglob("*.cpp"))}


def main(root):
    rooms = [room for room in rooms_of(root) if room]
    found = [clash for room in rooms for clash in (*clashes_in(room), *hidden_in(room))]
    print("\n".join(found) or f"{sum(map(len, rooms))} sources, each name without linkage once in its room")
    return 1 if found or not rooms else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
