"""Writes the manual page of the program and its completion for bash. Both are made from the help that each command
prints, so they need no text of their own: `python3 guide.py PROGRAM MAN_PAGE COMPLETION` (app/CMakeLists.txt). Where
the form of the help changes, TITLES and ENTRY have to follow, or options are missing in both without a message."""
import os
import re
import subprocess
import sys

# The patterns below read the help of a command. A line that matches TITLES begins the usage or a list. In a list, a
# line that matches ENTRY is an option, positional or command and its meaning; lines indented further continue the
# meaning.
TITLES = re.compile(r"^(Usage|Positionals|Subcommands|[A-Z][a-z ,]+):")
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(.*))?$")
# How bash completes a value of each kind, as an option of compgen: -f by files and folders, -d by folders alone. The
# kinds are the words that stand for values in the help. Values of other kinds are not completed, except choices.
FILES = {"FILE": "-f", "SCENE": "-f", "FLOES": "-f", "STUDY": "-f", "RUN": "-d", "DIR": "-d"}
# The script for bash. completion() replaces PATHS by the names of all commands, VALUES by a line for each option with a
# value, and KNOWN by a line for each command with its words.
COMPLETION = """# Completes polynya in bash. Made by python/polynya/guide.py.
_polynya() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  local path="" words="" choices="" value="" rest="" i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$path ${COMP_WORDS[i]}" in
    PATHS) path="$path ${COMP_WORDS[i]}" ;;
    esac
  done
  case "$path $before" in
VALUES  esac
  case "$path" in
KNOWN  esac
  if [[ -z $choices && -z $value ]]; then
    if [[ $current == -* ]]; then
      choices=$words
    else
      for i in $words; do [[ $i == -* ]] || choices="$choices $i"; done
      value=$rest
    fi
  fi
  COMPREPLY=()
  [[ -z $choices ]] || mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
  if [[ $value == -f || $value == -d ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen "$value" -- "$current")
  fi
}
complete -o filenames -F _polynya polynya
"""


class Command:
    """A command as its help describes it, with its subcommands. Members: `path`, the words that call it, empty for the
    program itself; `begin`, the text before the usage; `rest`, the text after the lists; `options`, pairs of names with
    the kind of value, as "--out DIR", and meaning, of its options and positionals; `commands`, its subcommands as
    Command. A subcommand whose help fails, such as one in Python that lacks a package, has only a text that refers to
    its help. If the help of the program itself fails, subprocess.CalledProcessError is raised."""

    def __init__(self, program, path=""):
        words = [program, *path.split(), "--help"]
        help_of = subprocess.run(words, capture_output=True, text=True, check=not path)
        text = help_of.stdout if help_of.returncode == 0 else f"polynya {path} --help explains its options.\n"
        self.path, self.begin, self.rest, self.options, self.commands = path, "", "", [], []
        entries, is_begin = None, True
        for line in text.splitlines():
            entry = ENTRY.match(line) if entries is not None else None
            if entry:
                entries.append([entry[1], entry[2] or ""])
            elif entries and line.startswith("     "):
                entries[-1][1] = f"{entries[-1][1]} {line.strip()}".strip()
            elif TITLES.match(line) and line != "Examples:" and not line.startswith("Exit codes"):
                is_begin = False
                entries = self.commands if line.startswith("Subcommands") else self.options
            elif is_begin:
                self.begin += line + "\n"
            elif line or self.rest:
                entries, self.rest = None, self.rest + line + "\n"
        self.commands = [Command(program, f"{path} {name}".strip()) for name, _ in self.commands]

    # Yields all commands below this one, each followed by its own subcommands.
    def all(self):
        for command in self.commands:
            yield command
            yield from command.all()

    def lists(self):
        """Yields, for each option and positional, its long names and the kind of its value. A positional has no names.
        The kind is the first word after the names, such as FILE, or a list of choices such as all|none. An option
        without a value has an empty kind or a remark of the help, such as Excludes."""
        for name, _ in self.options:
            names, _, rest = name.partition(" ")
            is_option = name.startswith("-")
            kind = re.split(r"[ :=]", rest if is_option else rest or name)[0]
            yield [each for each in names.split(",") if each.startswith("--")] if is_option else [], kind


# Escapes a text for a manual page: backslashes and hyphens, and a dot or apostrophe at the start of a line, which would
# be a command of roff.
def roff(words):
    words = words.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", words, flags=re.M)


# Returns the text of the manual page, in roff. `program` is the Command of the program itself, whose text after the
# lists becomes the section EXIT STATUS; `version` is shown in the footer.
def man_page(program, version):
    def section(command):  # the text of a command, without its heading
        text = f".PP\n.nf\n{roff(command.begin.strip())}\n.fi\n"
        for name, meaning in command.options:
            text += f".TP\n.B {roff(name)}\n{roff(meaning)}\n"
        return text + (f".PP\n{roff(command.rest)}" if command.rest and command is not program else "")

    text = f'.TH POLYNYA 1 "" "polynya {version}" "User Commands"\n'
    text += ".SH NAME\npolynya \\- simulate an icebreaker in pack ice\n"
    text += ".SH SYNOPSIS\n.B polynya\n.I command\n[\\fIoption\\fR ...]\n.SH DESCRIPTION\n" + section(program)
    text += ".SH COMMANDS\n" + "".join(f".SS {roff(each.path)}\n{section(each)}" for each in program.all())
    return text + f".SH EXIT STATUS\n{roff(program.rest)}"


# Returns the script for bash. For each command it has the words that may follow, and how other words are completed. Of
# several positionals the last one decides how they are completed.
def completion(program):
    values, known = "", ""
    for command in [program, *program.all()]:
        path = f" {command.path}" if command.path else ""
        words, rest = [each.path.split()[-1] for each in command.commands], "none"
        for names, kind in command.lists():
            choices = kind.replace("|", " ") if "|" in kind else ""
            words += names or choices.split()
            if not names:
                rest = FILES.get(kind, "none")
            elif kind not in ("", "Excludes", "Needs", "REQUIRED"):
                action = f'choices="{choices}"' if choices else f"value={FILES.get(kind, 'none')}"
                values += "".join(f'    "{path} {name}") {action} ;;\n' for name in names)
        known += f'    "{path}") words="{" ".join(words)} "; rest={rest} ;;\n'
    paths = "|".join(f'" {command.path}"' for command in program.all())
    return COMPLETION.replace("PATHS", paths).replace("VALUES", values).replace("KNOWN", known)


# Writes both files; existing ones are replaced. With only one name after the program only the manual page is written.
# Raises CalledProcessError or OSError, which end the build, if the program cannot be run or a file not be written.
def main():
    path, *files = sys.argv[1:]
    path = os.path.abspath(path)
    version = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    program = Command(path)
    for file, text in zip(files, (man_page(program, version), completion(program))):
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)


if __name__ == "__main__":
    main()
