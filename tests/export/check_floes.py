#!/usr/bin/env python3
"""Runs the Python of docs/run-folder.md that reads floes.ndjson, and compares every shape with `polynya inspect`.

    python3 check_floes.py POLYNYA RUN DOCS
"""
import json
import pathlib
import re
import subprocess
import sys

polynya, run, docs = sys.argv[1:]
section = pathlib.Path(docs).read_text().split("\n## floes.ndjson\n")[1].split("\n## ")[0]
(code,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
named = "runs/level-plate/floes.ndjson"
assert named in code
names = {}
exec(code.replace(named, f"{run}/floes.ndjson"), names)
shapes = names["shapes"]
del shapes[None]
lines = pathlib.Path(run, "floes.ndjson").read_text().splitlines()
of_parts = sum("ring_parts_m" in line for line in lines)
assert len(shapes) == len(lines) and of_parts > 20, (len(shapes), len(lines), of_parts)
for floe, rings in shapes.items():
    printed = subprocess.run([polynya, "inspect", run, "--floe", str(floe), "--format", "geojson"],
                             check=True, capture_output=True).stdout
    closed = json.loads(printed)["geometry"]["coordinates"]
    assert [ring + ring[:1] for ring in rings] == closed, floe
print(f"{len(shapes)} shapes, {of_parts} of them parts of their parents', are those of polynya inspect")
