"""A run of a scene, measured by its time of the processor. Not a program."""
import json
import os
import pathlib
import subprocess


def measured_run(program, folder, scene, *options):
    """Runs a scene without pictures into folder/run: that folder, its summary, and its time of the processor [s]."""
    file, run = pathlib.Path(folder) / "scene.json", pathlib.Path(folder) / "run"
    file.write_text(json.dumps(scene), encoding="utf-8")
    before = os.times()
    subprocess.run([program, "run", file, "--out", run, "--overwrite", "--progress", "none", *options], check=True,
                   capture_output=True)
    after = os.times()
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return run, json.loads((run / "summary.json").read_text(encoding="utf-8")), used
