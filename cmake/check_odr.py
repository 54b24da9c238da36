"""Finds one name with two types in the product: GCC's link-time optimiser compares every type it meets (-Wodr).

    python3 cmake/check_odr.py SOURCE WORK      objects go to WORK

Compiles the libraries, the program and the Python module without optimisation, for the link-time optimiser, and links
all of it at once. Sources that are built together are compiled together: a type that two of these have is an error of
the compiler. First it does so with two sources of its own that declare one name as two types: a compiler that does not
report those checks nothing. Objects are kept: only what changed is compiled again.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

ROOMS = ["elementary", "geometry", "dynamics", "fracture", "simulation", "io", "analysis", "views", "cosim", "app",
         "python_module"]
# Sources that define the functions of dynamics/parallel.cpp and thread_limit.cpp again, for programs without threads.
OTHER_DEFINITIONS = "dynamics/no_threads.cpp"
PLANTED = {
    "planted_a.cpp": "namespace polynya { struct Planted { int a; }; int use(Planted p) { return p.a; } }",
    "planted_b.cpp": "namespace polynya { struct Planted { double b; }; int use(Planted* p) { return p->b > 0; } }",
}
REPORT = re.compile(r"violates the C\+\+ One Definition Rule|\[-Wodr\]")


def compiler(command):
    """A compile command's words without what it writes, what it optimises and a launcher before the compiler."""
    words = shlex.split(command)
    while "ccache" in words[0]:
        words.pop(0)
    kept, skip = [], False
    for word in words:
        if skip or word in ("-o", "-c", "-MF", "-MT", "-include"):
            skip = not skip
            continue
        if not re.match(r"-(O\w*|g\d?|MD|W\w.*)$", word):
            kept.append(word)
    return kept


def compile_one(words, source, object_file, folder):
    """An error's text; empty where the object was made, or is newer than all that it was made from."""
    depends = object_file.with_suffix(".d")
    if object_file.exists() and depends.exists():
        made_from = depends.read_text().replace("\\\n", " ").split(":", 1)[1].split()
        made = object_file.stat().st_mtime
        files = [pathlib.Path(folder, name) for name in made_from]
        if all(file.exists() and file.stat().st_mtime < made for file in files):
            return ""
    command = [*words, "-O0", "-flto", "-fno-fat-lto-objects", "-w", "-MD", "-MF", depends]
    command += ["-c", source, "-o", object_file]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else ""


def reports_of_link(cxx, objects, work):
    """What a link of these objects reports of types that differ."""
    listed = work / "objects.txt"
    listed.write_text("\n".join(map(str, objects)))
    # A single partition is used, because GCC 12 ends with an internal error when it divides so large a relocatable
    # link.
    command = [cxx, "-r", "-O0", "-flto", "-flto-partition=one", "-flinker-output=nolto-rel", "-Wodr"]
    command += [f"@{listed}", "-o", work / "all.o"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"check_odr: the link failed:\n{done.stderr[-3000:]}")
    return [line for line in done.stderr.splitlines() if REPORT.search(line)], done.stderr


def find_planted(cxx, work):
    for name, text in PLANTED.items():
        (work / name).write_text(text)
        failure = compile_one([cxx, "-std=c++20"], work / name, (work / name).with_suffix(".o"), work)
        if failure:
            raise SystemExit(failure)
    found, _ = reports_of_link(cxx, [(work / name).with_suffix(".o") for name in PLANTED], work)
    return any("Planted" in line for line in found)


def entries(source, tree):
    """(words, file, folder, name) of each compilation of the product."""
    for entry in json.loads((tree / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        name = file.relative_to(tree if file.is_relative_to(tree) else source)
        if name.parts[0] in ROOMS and name.as_posix() != OTHER_DEFINITIONS:
            yield compiler(entry["command"]), file, entry["directory"], "-".join(name.parts)


def make_sources(tree, files):
    """Those that the build makes and these include."""
    included = {name for file in files for name in re.findall(r'^#include "(/.*)"', file.read_text(), re.MULTILINE)}
    made = sorted(name for name in included if not pathlib.Path(name).exists())
    if made:
        subprocess.run(["cmake", "--build", tree, "--target", *made], stdout=subprocess.DEVNULL, check=True)


def main(source, work):
    tree = work / "tree"
    configure = ["cmake", "--preset", "dev", "-S", source, "-B", tree, "-DPOLYNYA_BUILD_TESTS=OFF"]
    subprocess.run(configure, cwd=source, stdout=subprocess.DEVNULL, check=True)
    sources = list(entries(source, tree))
    if not sources:
        raise SystemExit(f"check_odr: {tree}/compile_commands.json lists no source of {source}")
    cxx = sources[0][0][0]
    if not find_planted(cxx, work):
        raise SystemExit(f"check_odr: {cxx} does not report two planted types of one name: nothing is checked")
    make_sources(tree, [file for _, file, _, _ in sources])
    objects = [work / f"{name}.o" for *_, name in sources]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        made = pool.map(lambda entry, out: compile_one(entry[0], entry[1], out, entry[2]), sources, objects)
        for (_, file, *_), failure in zip(sources, made):
            if failure:
                raise SystemExit(f"check_odr: {file} does not compile:\n{failure[-3000:]}")
    found, text = reports_of_link(cxx, objects, work)
    print(text if found else f"{len(objects)} compilations, no name with two types; two planted ones were found")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(word).resolve() for word in sys.argv[1:3])))
