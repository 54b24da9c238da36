"""Writes the page that holds the simulator: one HTML file with its scripts, its styles, the player, the scenes and the
module, packed by gzip and written in base64.

    python3 browser/page/join.py MODULE PLAYER_PAGE OUTPUT
"""
import base64
import gzip
import json
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).parent
SOURCE = HERE.parent.parent
PLAYER = SOURCE / "views/player"
# Scripts of the player that draw ice and ships and handle pointers.
SHARED = ["numbers.js", "motion.js", "map_view.js", "colours.js", "draw_ice.js", "draw_marks.js", "plan.js", "input.js",
          "plot_curves.js", "plot.js"]
OWN = ["save.js", "scene_text.js", "live_run.js", "live_map.js", "edit.js", "form.js", "plots.js", "helm.js", "page.js",
       "answers.js", "map_pointers.js", "live_actions.js", "start.js"]
WORKER = ["files.js", "simulator.js", "worker.js"]
SCENES = [("sawamura2017-fig4b", "The paper's voyage: a ship through floes"),
          ("level-plate", "Level ice: a ship breaks a channel by bending"),
          ("route-in-ice", "A ship follows a route through ice"),
          ("turning-circle", "Open water: a turning circle; take the helm"),
          ("at-sea", "A ship and floes at sea"),
          ("pressure", "Ice under pressure")]


def in_script(value):
    """JSON as it may stand in a script element."""
    return json.dumps(value, ensure_ascii=False).replace("<", "\\u003c")


def read_all(folder, names):
    return "".join((folder / name).read_text(encoding="utf-8") for name in names)


def plot_library():
    licence = (PLAYER / "vendor/uPlot-LICENSE").read_text(encoding="utf-8")
    return f"/*! uPlot:\n{licence}*/\n" + (PLAYER / "vendor/uPlot.iife.min.js").read_text(encoding="utf-8")


def joined(module, player_page):
    packed = gzip.compress(module, 9, mtime=0)
    scenes = [{"name": name, "title": title, "text": (SOURCE / f"scenes/{name}.json").read_text(encoding="utf-8")}
              for name, title in SCENES]
    parts = {
        "/*{{styles}}*/": read_all(PLAYER, ["vendor/uPlot.min.css", "player.css"]) + read_all(HERE, ["page.css"]),
        "{{scenes}}": in_script(scenes),
        "{{player}}": in_script(player_page),
        "{{worker}}": read_all(HERE, WORKER),
        "{{module}}": base64.b64encode(packed).decode(),
        "/*{{plot}}*/": plot_library(),
        "/*{{scripts}}*/": read_all(PLAYER, SHARED) + read_all(HERE, OWN),
    }
    page = (HERE / "page.html").read_text(encoding="utf-8")
    marks = "|".join(re.escape(mark) for mark in parts)
    return re.sub(marks, lambda match: parts[match.group()], page)


def main():
    module, player_page, output = map(pathlib.Path, sys.argv[1:])
    page = joined(module.read_bytes(), player_page.read_text(encoding="utf-8"))
    # `polynya view SCENE --live` replaces this mark by a scene.
    output.with_suffix(".template.html").write_text(page, encoding="utf-8")
    output.write_text(page.replace("{{own}}", "null"), encoding="utf-8")


if __name__ == "__main__":
    main()
