"""Fails on a function of the product above 50 lines, in C++ and JavaScript, and on more functions of six and more
parameters in C++ than there are today: values that belong together are one parameter.

    python3 cmake/check_sizes.py SOURCE

A function's lines are those from the parenthesis of its parameters (a lambda's without them: from its body) to its
closing brace, functions within it included.
"""
import pathlib
import re
import sys

ROOMS = ["elementary", "geometry", "dynamics", "fracture", "simulation", "io", "analysis", "views", "cosim", "browser",
         "app", "python"]
SUFFIXES = {".cpp", ".hpp", ".js"}
MOST_LINES_OF_FUNCTION = 50
MANY_PARAMETERS = 6
MOST_WITH_MANY_PARAMETERS = 15
# "path: name of the function" -> reason why the function is a table that is best read in one piece.
TABLES = {}

OF_STANDARD = re.compile("fmi2")  # functions whose parameters a standard has (cosim/fmi2.h)

CONTROL = {"if", "constexpr", "for", "while", "switch", "catch"}
CPP_SKIPPED = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^\s()\\]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.S)
JS_SKIPPED = re.compile(
    r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'"
    r"|(?<=[(,=:\[!&|?{};])\s*/(?![*/])(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n\[])+/")
PARAMETERS_END = re.compile(r"\)(?:\s*(?:const|noexcept|override|final|mutable|&|->[\w:<>,*&\s]+))*\s*$")


def blank(text):
    return re.sub(r"[^\n]", " ", text)


def end_of_template(text, at):
    """The end of the JavaScript template literal that begins at `at`, past the templates in its expressions."""
    depth, at = 0, at + 1
    while at < len(text):
        if text[at] == "\\":
            at += 1
        elif text[at] == "`" and depth == 0:
            return at + 1
        elif text[at] == "`":
            at = end_of_template(text, at) - 1
        elif text.startswith("${", at) and depth == 0:
            depth, at = 1, at + 1
        elif depth > 0:
            depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
    return at


def bare(path, text):
    """The text with its comments and strings blanked, each character in its place."""
    if path.endswith(".js"):
        at, parts = 0, []
        while at < len(text):
            skipped = JS_SKIPPED.match(text, at)
            end = skipped.end() if skipped else end_of_template(text, at) if text[at] == "`" else at + 1
            parts.append(blank(text[at:end]) if skipped or text[at] == "`" else text[at])
            at = end
        return "".join(parts)
    return CPP_SKIPPED.sub(lambda match: blank(match.group()), text)


def function_at(code, brace, partner):
    """Where the function begins whose body opens at `brace`, with its name; None where something else opens."""
    before = code[:brace].rstrip()
    if before.endswith("=>") or before.endswith("]"):
        before_parameters = before.removesuffix("=>").rstrip()
        start = partner.get(len(before_parameters) - 1, brace) if before_parameters.endswith(")") else brace
    elif before.endswith("}"):  # the members of a constructor
        start = brace
    else:
        end = PARAMETERS_END.search(before)
        if not end:
            return None
        start = partner.get(end.start(), brace)
    words = re.findall(r"[\w~:.]+|\W", code[max(0, start - 120):start].rstrip())
    name = words[-1] if words and re.match(r"\w", words[-1]) else "a function without a name"
    return None if name in CONTROL else (start, name)


DEFINITION = re.compile(r"\s*(?:const|noexcept|override|final|mutable|try|\s)*(?:->\s*[\w:<>,*&\s]+)?(?::[^{;]*)?\{")


def number_of_parameters(parameters):
    """Of the text between a function's parentheses."""
    depth, commas = 0, 0
    for character in parameters.replace("->", "  "):
        depth += {"(": 1, "<": 1, "[": 1, "{": 1, ")": -1, ">": -1, "]": -1, "}": -1}.get(character, 0)
        commas += character == "," and depth == 0
    return commas + 1 if parameters.strip() else 0


def with_many_parameters(path, text):
    """(place, name and number) of the functions that are defined with many parameters."""
    code, opened = bare(path, text), []
    for at, character in enumerate(code):
        if character == "(":
            opened.append(at)
        elif character == ")" and opened:
            start = opened.pop()
            name = re.search(r"([\w~:]+|\])\s*$", code[max(0, start - 100):start])
            count = number_of_parameters(code[start + 1:at])
            if (count >= MANY_PARAMETERS and name and name[1] not in CONTROL and not OF_STANDARD.match(name[1])
                    and DEFINITION.match(code, at + 1)):
                yield f"{path}:{code.count(chr(10), 0, start) + 1}: {name[1].replace(']', 'a lambda')} has {count}"


def problems_of(path, text):
    code = bare(path, text)
    opened, partner = [], {}
    for at, character in enumerate(code):
        if character in "({[":
            opened.append(at)
        elif character in ")}]":
            if not opened or code[opened[-1]] + character not in ("()", "{}", "[]"):
                yield f"{path}:{code.count(chr(10), 0, at) + 1}: '{character}' closes nothing that is open"
                return
            partner[at] = opened.pop()
            function = function_at(code, partner[at], partner) if character == "}" else None
            if function:
                start, name = function
                length = code.count("\n", start, at) + 1
                if length > MOST_LINES_OF_FUNCTION and f"{path}: {name}" not in TABLES:
                    line = code.count("\n", 0, start) + 1
                    yield f"{path}:{line}: {name} has {length} lines, more than {MOST_LINES_OF_FUNCTION}"
    if opened:
        yield f"{path}:{code.count(chr(10), 0, opened[-1]) + 1}: '{code[opened[-1]]}' is never closed"


def product_files(root):
    for room in ROOMS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in SUFFIXES and "vendor" not in path.parts:
                yield path


def main(root):
    found, files, many = [], 0, []
    for path in product_files(root):
        files += 1
        name, text = path.relative_to(root).as_posix(), path.read_text()
        found.extend(problems_of(name, text))
        many += with_many_parameters(name, text) if not name.endswith(".js") else ()
    if len(many) > MOST_WITH_MANY_PARAMETERS:
        found += [f"{len(many)} functions have {MANY_PARAMETERS} or more parameters, more than "
                  f"{MOST_WITH_MANY_PARAMETERS}:", *many]
    print("\n".join(found) or f"{files} files, their functions of at most {MOST_LINES_OF_FUNCTION} lines, "
          f"{len(many)} with {MANY_PARAMETERS} or more parameters")
    return 1 if found or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
