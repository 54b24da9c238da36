"""Fails on an include that goes up, sideways, or takes a package into a room it may not enter; and on what belongs
into one file only."""
import pathlib
import re
import sys

FLOOR = {"geometry": 0, "dynamics": 1, "fracture": 1, "simulation": 2, "io": 3, "app": 4}
# A package and the rooms that may include it.
PACKAGE_ROOMS = {
    r"<CGAL/": {"geometry"},
    r"<nlohmann/": {"io"},
    r"<Eigen/": {"fracture", "dynamics"},
    r"<CLI/": {"app"},
}
# What is written in one file only, and why.
ONE_FILE = {
    r"\bfmt::print\b|\bstd::(cout|cerr|clog)\b|\b(printf|fprintf|puts|fputs|putchar)\s*\(":
        ({"app/console.cpp", "simulation/simulation.cpp"}, "text goes out through app/console.hpp, which reports what could not be written"),
}
COMMENT = re.compile(r"//.*")
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')


def problems_in(path: pathlib.Path, room: str):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        for pattern, (files, reason) in ONE_FILE.items():
            found = re.search(pattern, COMMENT.sub("", line))
            if found and not any(str(path).endswith(file) for file in files):
                yield f"{path}:{number}: {found.group(0)}: {reason}"
        match = INCLUDE.match(line)
        if not match:
            continue
        target = match.group(2)
        other = target.split("/")[0]
        place = f"{path}:{number}"
        if match.group(1) == '"' and other in FLOOR and other != room and FLOOR[other] >= FLOOR[room]:
            yield f"{place}: {room} (floor {FLOOR[room]}) includes {target} (floor {FLOOR[other]})"
        if match.group(1) == '"' and "/internal/" in target and other != room:
            yield f"{place}: {target} is internal to {other}"
        for package, rooms in PACKAGE_ROOMS.items():
            if (match.group(1) + target).startswith(package) and room not in rooms:
                yield f"{place}: <{target}> may be included only in {sorted(rooms)}"
        if target.startswith("CGAL/") and path.suffix == ".hpp" and "internal" not in path.parts:
            yield f"{place}: CGAL stays out of public headers"


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    found = []
    files = 0
    for room in FLOOR:
        for path in sorted((root / room).rglob("*.[ch]pp")):
            files += 1
            found.extend(problems_in(path, room))
    print("\n".join(found) or f"{files} files, includes go down")
    return 1 if found or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
