"""Draws docs/images/rooms.svg: the rooms of the source with their sizes, and which includes which.

    python3 tools/rooms.py            writes it
    python3 tools/rooms.py --check    fails where it shows other rooms or arrows than the tree has, or a size that is
                                      more than a tenth off

Sizes have two digits, and the check bears a tenth, so that a few new lines or files ask nobody to draw the picture
again. An arrow goes from a room to one whose headers it includes; arrows that follow from others (a room below a room
below) are left out.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "cmake"))
from check_layers import FLOORS, room_of  # noqa: E402

PICTURE = ROOT / "docs/images/rooms.svg"
MEANING = {
    "elementary": "sin, exp and the like, to the bit",
    "geometry": "shape and place, exact cuts",
    "dynamics": "mass, force, time",
    "fracture": "when and where ice fails",
    "simulation": "scene, world, step",
    "io": "scenes in, run folders out",
    "analysis": "what is measured in a run",
    "views": "map, player, exports",
    "cosim": "co-simulation units",
    "browser": "the simulator in a page",
    "app": "the command line",
    "python/module": "polynya._core",
}
WIDTH, BOX, SUB, GAP = 860, 46, 40, 34  # [px]


def top_of(room):
    return room if room == "python/module" else room.split("/")[0]


def two_digits(number):
    unit = 10 ** max(0, len(str(number)) - 2)
    return f"{round(number / unit) * unit:,}".replace(",", " ")


def read_tree():
    """Files and lines of each room of the layer check, and the rooms whose headers each top room includes."""
    sizes = {room: [0, 0] for room in FLOORS}
    includes = {top_of(room): set() for room in FLOORS}
    for folder in sorted({room.split("/")[0] for room in FLOORS}):
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            room = room_of(name)
            if path.suffix not in (".cpp", ".hpp", ".js") or "vendor" in name or room is None:
                continue
            text = path.read_text()
            sizes[room][0] += 1
            sizes[room][1] += text.count("\n")
            for target in re.findall(r'^#include "([^"]+)"', text, re.M):
                if room_of(target) and top_of(room_of(target)) != top_of(room):
                    includes[top_of(room)].add(top_of(room_of(target)))
    return sizes, includes


def below(room, includes):
    return includes[room].union(*(below(other, includes) for other in includes[room])) if includes[room] else set()


def direct(includes):
    """Without what follows from others."""
    return {room: {other for other in targets
                   if not any(other in below(between, includes) for between in targets)}
            for room, targets in includes.items()}


def level(room, includes):
    return 1 + max((level(other, includes) for other in includes[room]), default=-1)


def size_text(sizes, room):
    rooms = [name for name in sizes if top_of(name) == room] if room == top_of(room) else [room]
    files, lines = (sum(sizes[name][i] for name in rooms) for i in (0, 1))
    return f"{files} files, {two_digits(lines)} lines"


def text(x, y, words, size, anchor="start", weight="normal"):
    return f'<text x="{x:g}" y="{y:g}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}">{words}</text>'


def draw_room(room, x, y, width, sizes):
    subs = [name for name in sizes if name.startswith(room + "/")] if room == top_of(room) else []
    height = BOX + (SUB + 8 if subs else 0)
    parts = [f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height}" rx="6" fill="#eaf2f8" stroke="#3b6a8f"/>',
             text(x + 12, y + 20, room, 16, weight="bold"),
             text(x + 12, y + 37, MEANING[room], 12),
             text(x + width - 12, y + 20, size_text(sizes, room), 12, "end")]
    each = (width - 16) / max(1, len(subs))
    for i, sub in enumerate(subs):
        left = x + 8 + i * each
        parts.append(f'<rect x="{left + 3:g}" y="{y + BOX:g}" width="{each - 6:g}" height="{SUB}" rx="4" fill="#fff" '
                     'stroke="#8fb0c9"/>')
        parts.append(text(left + each / 2, y + BOX + 17, sub.split("/", 1)[1], 12, "middle"))
        parts.append(text(left + each / 2, y + BOX + 32, f"{two_digits(sizes[sub][1])} lines", 10, "middle"))
    return parts, height


def picture():
    sizes, includes = read_tree()
    levels = {}
    for room in includes:
        levels.setdefault(level(room, includes), []).append(room)
    parts, places, y = [], {}, 14
    for floor in sorted(levels, reverse=True):
        rooms = levels[floor]
        width = (WIDTH - 28 - GAP * (len(rooms) - 1)) / len(rooms)
        tallest = 0
        for i, room in enumerate(rooms):
            x = 14 + i * (width + GAP)
            drawn, height = draw_room(room, x, y, width, sizes)
            parts += drawn
            places[room] = (x, y, width, height)
            tallest = max(tallest, height)
        y += tallest + GAP
    for room, targets in sorted(direct(includes).items()):
        for other in sorted(targets):
            x0, y0, w0, h0 = places[room]
            x1, y1, w1, _ = places[other]
            left, right = max(x0, x1), min(x0 + w0, x1 + w1)
            x = (left + right) / 2
            parts.append(f'<line x1="{x:g}" y1="{y0 + h0:g}" x2="{x:g}" y2="{y1 - 2:g}" stroke="#3b6a8f" '
                         'stroke-width="1.5" marker-end="url(#arrow)"/>')
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y - GAP + 14}" font-family="sans-serif" '
        'fill="#1c2b36">',
        '<defs><marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0 8 4 0 8z" fill="#3b6a8f"/></marker></defs>',
        f'<rect width="{WIDTH}" height="{y - GAP + 14}" fill="#fff"/>', *parts, "</svg>", ""])


SIZE = re.compile(r"(?:(\d+) files, )?(\d[\d ]*) lines")


def shows(drawn, made):
    """Whether the picture as drawn shows what the tree gives: the same rooms and arrows, and sizes within a tenth."""
    if SIZE.sub("", drawn) != SIZE.sub("", made):
        return False
    pairs = zip(SIZE.finditer(drawn), SIZE.finditer(made))
    sizes = ([int((size[i] or "0").replace(" ", "")) for size in pair] for pair in pairs for i in (1, 2))
    return all(abs(old - new) <= 0.1 * new for old, new in sizes)


def main(words):
    parser = argparse.ArgumentParser(description="Draws docs/images/rooms.svg from the tree.")
    parser.add_argument("--check", action="store_true", help="fail where it does not show what the tree has")
    made, options = picture(), parser.parse_args(words)
    if options.check:
        if PICTURE.exists() and shows(PICTURE.read_text(), made):
            return 0
        print(f"{PICTURE.relative_to(ROOT)} does not show what the tree has: python3 tools/rooms.py")
        return 1
    PICTURE.write_text(made)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
