"""Fails on an include that goes up, between siblings, into another room's internals, or to a foreign package's header,
and on Python modules that import each other in a circle.

    python3 cmake/check_layers.py SOURCE
"""
import ast
import pathlib
import re
import sys

# Room or sub-room -> floor. An include goes to the same folder or to a lower floor.
FLOORS = {
    "elementary": -1,
    "geometry/shape": 0,
    "geometry/exact": 1,
    "geometry/cut": 2,
    "geometry/contact": 3,  # first contact asks for exact overlaps
    "dynamics": 4,
    "dynamics/contact": 5,
    "dynamics/water": 5,
    "dynamics/ship": 5,
    "fracture": 5,
    "simulation/field": 6,
    "simulation/world": 7,
    "simulation/ship": 7,
    "simulation/ice": 7,
    "simulation/state": 8,
    "simulation": 9,
    "io/text": 10,
    "io/import": 11,
    "io/scene": 12,
    "io/run": 13,
    "analysis": 14,
    "views/map": 15,
    "views/player": 16,
    "views/export": 16,
    "cosim": 15,
    "cosim/unit": 16,
    "browser": 17,
    "app/command_line": 17,
    "app/run": 18,
    "app/ice": 18,
    "app/read": 18,
    "app/database": 18,
    "app": 19,
    "python/module": 19,
}
# Rooms that must not include each other, whatever their floors.
APART = [{"dynamics", "fracture"}]
# Folders that say what their files are about, and include each other: a stage of the step changes the world, and the
# world holds what ships and ice remember.
TOGETHER = {"simulation/world", "simulation/ship", "simulation/ice"}
# Header of a package -> the only folders, or files, that include it.
PACKAGES = {
    r"CGAL/": ["geometry/"],
    r"gmp(xx)?\.h": ["geometry/exact/internal/rational.hpp"],
    r"boost/multiprecision/": ["browser/platform/"],
    r"(tbb|oneapi)/": ["dynamics/"],
    r"Eigen/": ["fracture/bending/", "dynamics/contact/internal/jam_matrix"],
    r"boost/container/": ["dynamics/"],
    r"boost/math/": ["fracture/bending/"],
    r"boost/crc": ["io/text/"],
    r"nlohmann/": ["io/text/"],
    r"CLI/": ["app/command_line/command_line.cpp"],
    r"fmt/": ["simulation/", "io/", "analysis/", "views/", "cosim/", "browser/module/", "app/", "python/module/"],
    r"pybind11/": ["python/module/"],
    r"windows\.h": ["cosim/windows/"],
    r"tl/expected": [""],
}
# Headers that a browser lacks (files, programs, threads) -> the only folders or files that may include them. Other code
# that needs a file receives its text, or a function that reads it (io/scene/floe_files.hpp).
SYSTEM = {
    r"(filesystem|fstream|(fcntl|unistd|dirent|spawn)\.h|sys/(stat|file|wait|resource)\.h)$":
        ["io/text/source_text", "io/text/output_file", "io/text/child_process", "io/import/", "io/scene/scene_file",
         "io/run/", "analysis/", "views/", "cosim/packing", "cosim/unit/component", "browser/platform/",
         "app/", "python/module/"],
    r"(thread|mutex|condition_variable|future|shared_mutex)$": ["dynamics/", "fracture/bending/database.cpp",
                                                                "browser/platform/", "app/", "python/module/"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
STANDARD = re.compile(
    r"[a-z_0-9]+$|(sys|bits|linux|sanitizer)/[a-z_]+\.h$|"
    r"(unistd|fcntl|dirent|signal|poll|errno|spawn|emmintrin|link)\.h$")


def room_of(path):
    """The deepest room with a floor that the path lies in."""
    inside = [room for room in FLOORS if path.startswith(room + "/")]
    return max(inside, key=len, default=None)


def problems_of_own(path, room, target):
    other = room_of(target)
    if other is None:
        yield f"{target} lies in no room"
    elif {room, other} <= TOGETHER:
        return
    elif other != room and FLOORS[other] >= FLOORS[room]:
        yield f"{room} (floor {FLOORS[room]}) includes {target} (floor {FLOORS[other]})"
    elif {path.split("/")[0], target.split("/")[0]} in APART:
        yield f"{room} includes {target}, to which it is blind"
    if "/internal/" in target and target.split("/")[0] != path.split("/")[0]:
        yield f"{target} is internal to {target.split('/')[0]}"


def problems_of_foreign(path, target):
    for header, places in SYSTEM.items():
        if re.match(header, target) and not any(path.startswith(place) for place in places):
            yield f"<{target}> may be included only in {places}"
    if STANDARD.match(target):
        return
    for package, places in PACKAGES.items():
        if re.match(package, target):
            if not any(path.startswith(place) for place in places):
                yield f"<{target}> may be included only in {places}"
            elif path.endswith(".hpp") and target.startswith("CGAL/") and "/internal/" not in path:
                yield f"<{target}>: CGAL stays out of public headers"
            return
    yield f"<{target}> belongs to no package that cmake/check_layers.py lists"


def problems_of(path, text):
    room = room_of(path)
    if room is None:
        yield f"{path}: lies in no room of cmake/check_layers.py"
        return
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        kind, target = match.groups()
        found = problems_of_own(path, room, target) if kind == '"' else problems_of_foreign(path, target)
        for problem in found:
            yield f"{path}:{number}: {problem}"


def python_imports(root):
    """Module -> our own modules that it imports where it starts, for its types too. (Imports in functions are late:
    what a module asks for when it is used.)"""
    modules = {}
    for path in sorted((root / "python").rglob("*.py")):
        parts = path.relative_to(root / "python").with_suffix("").parts
        modules[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    imports = {module: set() for module in modules}
    for module, path in modules.items():
        package = module.split(".") if path.name == "__init__.py" else module.split(".")[:-1]
        tree = ast.parse(path.read_text(encoding="utf-8"))
        functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
        late = {id(node) for function in functions for node in ast.walk(function)}
        for node in ast.walk(tree):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                base = package[:len(package) - node.level + 1] if node.level else []
                source = ".".join(base + ([node.module] if node.module else []))
                names = [f"{source}.{alias.name}" for alias in node.names]
                names = [name if name in modules else source for name in names]
            imports[module] |= {name for name in names if name in modules and name != module and id(node) not in late}
    return imports


def circles(imports):
    """Each circle of imports once, as its modules in order."""
    done = set()

    def walk(module, way):
        if module in way:
            yield " imports ".join([*way[way.index(module):], module])
        elif module not in done:
            for other in sorted(imports[module]):
                yield from walk(other, [*way, module])
            done.add(module)

    for module in sorted(imports):
        yield from walk(module, [])


def main(root):
    found, files = list(circles(python_imports(root))), 0
    for top in sorted({room.split("/")[0] for room in FLOORS}):
        for path in sorted((root / top).rglob("*.[ch]pp")):
            files += 1
            found.extend(problems_of(path.relative_to(root).as_posix(), path.read_text()))
    print("\n".join(found) or f"{files} files, includes go down")
    return 1 if found or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
