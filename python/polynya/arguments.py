"""Command lines of the commands that are written in Python: argparse, with the help and the messages of those in C++
(app/command_line/command_line.cpp)."""
import argparse
import difflib
import math
import re
import sys
import textwrap

# Column of --help in which meanings begin, as in the commands in C++, and width of its lines [characters]. A larger
# column leaves room for longer names, and narrower lines wrap meanings more often.
COLUMN, WIDTH = 30, 100


def meant_by(word, names):
    """The end of a message on a mistyped word, with the name that is most like it; empty if none is (similarity 0.6 of
    difflib)."""
    near = difflib.get_close_matches(word, names, 1)
    return f"; did you mean {near[0]}?" if near else ""


def number(least=-math.inf, most=math.inf, unit="", kind=float, is_open=False):
    """Returns a function that reads a finite number from a text, for the `type` of an option. Values from `least` to
    `most` are allowed; if `is_open`, the limits themselves are not. `unit` is that of the number in messages, and
    `kind` is float or int. The function raises argparse.ArgumentTypeError with the text and what is allowed."""
    signs = (">", "<") if is_open else ("≥", "≤")
    ends = [f"{sign} {end:g}" for sign, end in zip(signs, (least, most)) if math.isfinite(end)]
    what = "a whole number" if kind is int else "a number"
    allowed = " ".join(filter(None, [what, ", ".join(ends), f"[{unit}]" if unit else ""]))

    def read(text):
        try:
            value = kind(text)
            holds = math.isfinite(value) and (least < value < most if is_open else least <= value <= most)
        except (ValueError, OverflowError):
            holds = False
        if not holds:
            raise argparse.ArgumentTypeError(f"found {text[:60]}, allowed: {allowed}")
        return value

    return read


WHOLE = number(1, kind=int)  # reads a whole number from 1


def numbers(one=number(), count=None):
    """Returns a function that reads a list of numbers, separated by commas. Each is read by `one`, with its errors.
    There must be `count` numbers, if that is given, otherwise at least one; blanks around a number are allowed."""

    def read(text):
        values = [one(part) for part in text.split(",")]
        if count is not None and len(values) != count:
            raise argparse.ArgumentTypeError(f"found {text[:60]}, allowed: {count} numbers, separated by commas")
        return values

    return read


def choice(names):
    """Returns a function that accepts one of these names and returns it. It raises argparse.ArgumentTypeError, with the
    name that may have been meant, for another one. Capitals matter."""

    def read(text):
        if text not in names:
            raise argparse.ArgumentTypeError(f'"{text}" is not one of: {", ".join(names)}{meant_by(text, names)}')
        return text

    return read


def choices(names):
    """Returns a function that reads a list of these names, separated by commas without blanks. Names that occur twice
    stay twice."""
    return lambda text: [choice(names)(part) for part in text.split(",")]


class Parser(argparse.ArgumentParser):
    """Command line of `prog`, such as "polynya loads", in the form of the commands in C++. --help shows `meaning`, its
    purpose, without a full stop; `examples`, lines without "polynya"; then the options, and `rest` after them. Options
    cannot be shortened. Errors end the process with exit code 2, --help with 0."""

    def __init__(self, prog, meaning, examples, rest=""):
        super().__init__(prog=prog, allow_abbrev=False, add_help=False)
        self.meaning, self.examples, self.rest, self.actions_of = meaning, examples, rest, None
        self.add_argument("-h", "--help", action="help", help="Print this help message and exit")

    def add(self, name, meaning, **more):
        """Adds an option or a positional argument. `meaning` is its text in --help. `more` are arguments of
        add_argument(); --help shows the name of a value only if `metavar` states it."""
        return self.add_argument(name, help=meaning, **more)

    def add_actions(self):
        """Makes this a command with actions, such as `polynya study plan`, one of which must be given. Returns the
        object with add_parser() for the parsers of actions. The parsed options name the chosen one as `action`."""
        self.actions_of = self.add_subparsers(dest="action", metavar="ACTION", required=True)
        return self.actions_of

    def commands(self):
        """{name: parser} of the actions of this command, in the order of add_parser(); empty if it has none."""
        return self.actions_of.choices if self.actions_of else {}

    def arguments(self):
        """Positionals and options in their order, as argparse's actions, without the choice of an action."""
        return [argument for argument in self._actions if argument is not self.actions_of]

    def format_help(self):
        """The text of --help: purpose, examples, usage, positionals, options and actions."""
        positionals = [argument for argument in self.arguments() if not argument.option_strings]
        options = [argument for argument in self.arguments() if argument.option_strings]
        names = [f"{argument.metavar}{'...' if argument.nargs == '+' else ''}" for argument in positionals]
        names += ["ACTION"] if self.actions_of else []
        parts = [self.meaning + ".\n" if self.meaning else "", self.shown_examples()]
        parts.append(f"Usage: {self.prog} {' '.join(['[OPTIONS]', *names])}\n")
        for title, found in (("Positionals", positionals), ("Options", options)):
            if found:
                parts.append(f"{title}:\n" + "".join(entry(spelled(argument), argument.help) for argument in found))
        if self.actions_of:
            parts.append("Subcommands:\n" + "".join(entry(name, of.meaning) for name, of in self.commands().items()))
        return "\n".join([*filter(None, parts), self.rest]).rstrip("\n") + "\n"

    # The paragraph "Examples" of --help.
    def shown_examples(self):
        return "Examples:\n" + "".join(f"  polynya {example}\n" for example in self.examples)

    def parse_known_args(self, args=None, namespace=None):
        """Parses as argparse does, but unknown words are an error, with the option that may have been meant, so the
        second result is always empty. argparse uses this method also for the words of an action."""
        found, rest = super().parse_known_args(self.joined(sys.argv[1:] if args is None else args), namespace)
        if rest:
            names = [name for argument in self.arguments() for name in argument.option_strings]
            option = next((word for word in rest if word.startswith("-")), None)
            hint = meant_by(option.partition("=")[0], names) if option else ""
            self.error(f"not expected: {' '.join(rest)}{hint}")
        return found, rest

    def joined(self, words):
        """Joins each option and its value into one word, because argparse takes a value that begins with a dash, such
        as -inf or -10,0, for an option. A word that begins with "--", or is -h, is never a value. Words after "--" stay
        as they are."""
        valued = {name for a in self.arguments() if a.nargs is None for name in a.option_strings}
        found, left = [], list(words)
        while left:
            word = left.pop(0)
            if word == "--":
                return [*found, word, *left]
            is_split = word in valued and left and not left[0].startswith("--") and left[0] != "-h"
            found.append(f"{word}={left.pop(0)}" if is_split else word)
        return found

    def error(self, message):
        """Ends the process with exit code 2 after a message on stderr."""
        self.exit(2, f"{self.prog}: {self.in_plain_words(message)}\n{self.prog} --help explains its options\n")

    def in_plain_words(self, message):
        """Rewrites a message of argparse in the words of the commands in C++. Of several missing arguments only the
        first is named. A message that is not known stays as it is, except for the word "argument"."""
        commands = list(self.commands())
        wrong = re.match(r"argument ACTION: invalid choice: '(.*?)' \(choose", message)
        if wrong:
            return f"no such command: {wrong[1]}{meant_by(wrong[1], commands)}\ncommands: {', '.join(commands)}"
        if message.startswith("the following arguments are required: "):
            if self.actions_of:
                return f"a command is missing\ncommands: {', '.join(commands)}"
            name = message.removeprefix("the following arguments are required: ").split(",")[0]
            asked = next(a for a in self.arguments() if name in (a.metavar, *a.option_strings))
            return f"{name} is missing: {asked.help}"
        message = message.removeprefix("argument ").replace("not allowed with argument", "not allowed with")
        return re.sub(r": expected one argument$", " needs a value", message)


def spelled(argument):
    """The name of an argument in --help, such as "--out DIR" or "-h,--help"."""
    if not argument.option_strings:
        return argument.metavar
    return ",".join(argument.option_strings) + (f" {argument.metavar}" if argument.metavar else "")


def entry(name, meaning):
    """Lines of a list of --help: a name, and its meaning in the column COLUMN, broken into lines of at most WIDTH
    characters. A long name has its own line."""
    lines = textwrap.wrap(meaning, WIDTH - COLUMN, break_long_words=False)
    head = f"  {name}"
    first = f"{head}\n{'':{COLUMN}}" if len(head) >= COLUMN else f"{head:{COLUMN}}"
    return first + f"\n{'':{COLUMN}}".join(lines) + "\n"
