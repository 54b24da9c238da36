"""Runs of scenes that commands make: finished ones are kept, and used again where the scene is the same."""
import json
import subprocess

from .files import writing
from .study.case import DONE, STOPPED, is_finished


class RunFailed(Exception):
    pass


def kept_run(program, folder, name, scene, has_map=True):
    """The run's folder, folder/name; of a run that is there already, at once. `has_map`: with a picture of its end."""
    path, run = folder / (name + ".json"), folder / name
    text = json.dumps(scene, indent=1)
    if is_finished(run) and path.is_file() and path.read_text(encoding="utf-8") == text:
        return run
    with writing(path) as file:
        file.write(text)
    done = subprocess.run(
        [program, "run", path, "--out", run, "--overwrite", "--progress", "none", "--threads", "1"]
        + ([] if has_map else ["--no-map"]),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    if done.returncode == STOPPED:  # Ctrl-C reaches the run too
        raise KeyboardInterrupt
    if done.returncode != DONE:
        raise RunFailed(f"{path}: polynya run ended with {done.returncode}\n{done.stderr.strip()}")
    return run
