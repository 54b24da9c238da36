"""JSON with comments whose values know their place, and problems that name it."""
import dataclasses
import json
import json.scanner
import re

COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', re.S)


@dataclasses.dataclass(frozen=True)
class Problem:
    """One thing wrong in a file."""

    file: str
    path: str
    message: str
    line: int = 0  # from 1; 0 where there is no place
    column: int = 0

    def __str__(self):
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{place}: {self.path}: {self.message}" if self.path else f"{place}: {self.message}"


class StudyError(Exception):
    """What is wrong with a study; `code` is what the command exits with (app/exit_code.hpp)."""

    def __init__(self, problems, code=3):
        self.problems = [problems] if isinstance(problems, (str, Problem)) else list(problems)
        self.code = code
        super().__init__("\n".join(str(problem) for problem in self.problems))


def without_comments(text):
    """The text with its comments blanked, each other character in its place."""

    def blank(match):
        return match[0] if match[0].startswith('"') else re.sub(r"[^\n]", " ", match[0])

    return COMMENT.sub(blank, text)


def read_json(path):
    """The value of a JSON file with comments, without places."""
    return json.loads(without_comments(path.read_text(encoding="utf-8")))


class LocatedJson:
    """A JSON file with comments. `value` is what it holds; `problem(path, …)` names a place in it."""

    def __init__(self, file, text):
        self.file, self._text = str(file), without_comments(text)
        try:
            self.value, self._tree = self._scan()
        except json.JSONDecodeError as error:
            raise StudyError(Problem(self.file, "", error.msg, error.lineno, error.colno)) from None
        except RecursionError:
            raise StudyError(Problem(self.file, "", "nested too deeply")) from None

    def _scan(self):
        """The value, and a tree of (offset, subtrees) of the values in it, in the order of the text."""
        decoder = json.JSONDecoder(object_pairs_hook=self._object)
        decoder.parse_object, decoder.parse_array = json.decoder.JSONObject, json.decoder.JSONArray
        scan, open_lists = json.scanner.py_make_scanner(decoder), [[]]

        def located(text, at):
            open_lists.append([])
            value, end = scan_once(text, at)
            inner = open_lists.pop()
            open_lists[-1].append((at, inner))
            return value, end

        # The scanner calls itself for what is inside: by `located`.
        def scan_once(text, at):
            character = text[at : at + 1]
            if character == "{":
                return decoder.parse_object((text, at + 1), True, located, None, decoder.object_pairs_hook, {})
            if character == "[":
                return decoder.parse_array((text, at + 1), located)
            try:
                return scan(text, at)
            except StopIteration as stop:
                raise json.JSONDecodeError("Expecting value", text, stop.value) from None

        start = len(self._text) - len(self._text.lstrip())
        value, end = located(self._text, start)
        if self._text[end:].strip():
            rest = end + len(self._text[end:]) - len(self._text[end:].lstrip())
            raise json.JSONDecodeError("Extra data", self._text, rest)
        return value, open_lists[0][0]

    def _object(self, pairs):
        keys = [key for key, _ in pairs]
        for key in keys:
            if keys.count(key) > 1:
                raise StudyError(Problem(self.file, key, f'"{key}" stands twice'))
        return dict(pairs)

    def problem(self, path, message):
        """A problem of the value at a path of keys and indices, or of the nearest one that there is."""
        value, (at, inner) = self.value, self._tree
        for step in path:
            steps = (
                list(value) if isinstance(value, dict) else list(range(len(value))) if isinstance(value, list) else []
            )
            if step not in steps:
                break
            at, inner = inner[steps.index(step)]
            value = value[step]
        line = self._text.count("\n", 0, at) + 1
        column = at - (self._text.rfind("\n", 0, at) + 1) + 1
        return Problem(self.file, path_in_words(path), message, line, column)


def path_in_words(path):
    """draw.of["ice.thickness_m"].normal.sd"""
    words = ""
    for step in path:
        if isinstance(step, int):
            words += f"[{step}]"
        elif re.fullmatch(r"\w+", step):
            words += ("." if words else "") + step
        else:
            words += f'["{step}"]'
    return words
