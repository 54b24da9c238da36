"""Pages of the site's reference that are made from the program and the Python package."""
import subprocess

# Module: what of it is documented; without names, all that is public.
PYTHON = {
    "polynya": ["Scene", "Simulation", "Ship", "SeenShip", "PilotView", "Floes", "FloeMemory", "cut", "Cut", "Run",
                "Study", "Problem", "SceneError", "SimulationError", "FolderError", "require"],
    "polynya.environment": [],
    "polynya.statistics": [],
    "polynya.formulas": [],
}


def printed(polynya, *arguments):
    return subprocess.run([polynya, *arguments], capture_output=True, text=True, check=True).stdout


def commands(polynya):
    """`polynya --help` and each command's own."""
    whole = printed(polynya, "--help")
    names = [line.split()[0] for line in whole.split("Subcommands:\n")[1].split("\n\n")[0].splitlines()
             if line.startswith("  ") and not line.startswith("   ")]
    text = f"# Commands\n\nWhat `polynya --help` and `polynya COMMAND --help` print.\n\n```text\n{whole}```\n"
    for name in names:
        text += f"\n## polynya {name}\n\n```text\n{printed(polynya, name, '--help')}```\n"
        parts = printed(polynya, name, "--help").split("Subcommands:\n")
        for line in parts[1].split("\n\n")[0].splitlines() if len(parts) > 1 else []:
            if line.startswith("  ") and not line.startswith("   "):
                inner = line.split()[0]
                text += f"\n### polynya {name} {inner}\n\n```text\n{printed(polynya, name, inner, '--help')}```\n"
    return text


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
