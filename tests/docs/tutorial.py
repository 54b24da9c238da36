"""Does what docs/tutorial.md does, in a fresh folder, and fails where a command prints other than the page shows.

    python3 tests/docs/tutorial.py SOURCE POLYNYA            --renew writes what is printed today into the page

A fenced block with a file's name behind its language is written to that file; of one without a language, lines that
begin with "$ " are run by a shell, and what follows is their output, stdout and stderr. Times by the clock and
imbalances, which are rounding, do not count; an ellipsis in a line of its own stands for lines that are left out.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

FENCE = re.compile(r"^```(\w*)[ ]?(\S*)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
UNCOUNTED = re.compile(r" in [\d.e+-]+ s, [\d.e+-]+ x real time|\(imbalance [^)]*\)")
LEFT_OUT = re.compile(r" *…$")


def counted(text):
    return UNCOUNTED.sub("", text).rstrip() + "\n"


def commands_of(block):
    """(command, shown output) of a block, in its order."""
    parts = re.split(r"^\$ (.*)\n", block, flags=re.MULTILINE)
    assert parts[0] == "", f"a block begins with a command, not with {parts[0]!r}"
    return list(zip(parts[1::2], parts[2::2]))


def is_as_shown(printed, shown):
    lines = counted(shown).splitlines()
    pattern = "".join(".*" if LEFT_OUT.fullmatch(line) else re.escape(line) + "\n" for line in lines)
    return re.fullmatch(pattern, counted(printed), re.DOTALL) is not None


def shortened(printed, shown):
    """What is printed, with as many first and last lines as are shown around an ellipsis."""
    lines, old = printed.splitlines(), shown.splitlines()
    marks = [k for k, line in enumerate(old) if LEFT_OUT.fullmatch(line)]
    if not marks or len(old) > len(lines):
        return printed
    return "\n".join(lines[: marks[0]] + ["…"] + lines[len(lines) - (len(old) - marks[0] - 1):]) + "\n"


def run_page(page, polynya):
    """The page with what its commands print, what was not as shown, and what failed."""
    found, failed = [], []
    environment = {**os.environ, "PATH": f"{pathlib.Path(polynya).resolve().parent}:/usr/bin:/bin"}

    def done(match):
        language, file, body = match.groups()
        if file:
            pathlib.Path(folder, file).write_text(body)
        if language or not body.startswith("$ "):
            return match[0]
        new = ""
        for command, shown in commands_of(body):
            end = subprocess.run(["/bin/sh", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            if end.returncode != 0:
                failed.append(f"$ {command}\n{end.stdout}exit code {end.returncode}")
            elif not is_as_shown(end.stdout, shown):
                found.append(f"$ {command}\n{end.stdout}the page has\n{shown}")
            new += f"$ {command}\n{shown if is_as_shown(end.stdout, shown) else shortened(end.stdout, shown)}"
        return f"```\n{new}```\n"

    with tempfile.TemporaryDirectory() as folder:
        return FENCE.sub(done, page), found, failed


def main(root, polynya, *options):
    needed = ["/usr/bin/python3", "-c", "import numpy, scipy, matplotlib"]
    if subprocess.run(needed, capture_output=True, check=False).returncode != 0:
        print("skipped: /usr/bin/python3 has no numpy, scipy or matplotlib (./setup.sh python)")
        return 77
    path = pathlib.Path(root, "docs/tutorial.md")
    page = path.read_text()
    new, found, failed = run_page(page, polynya)
    if "--renew" in options:
        path.write_text(new)
        found = []
    if found:
        failed.append("python3 tests/docs/tutorial.py . build/dev/app/polynya --renew")
    print("\n".join(found + failed) or "docs/tutorial.md: every output as it is shown")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
