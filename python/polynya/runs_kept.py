"""Runs of scenes that commands make. Finished runs are kept, and reused if the scene is the same."""
import json
import subprocess

from .files import writing
from .study.case import DONE, STOPPED, is_finished


class RunFailed(Exception):
    pass


def kept_run(program, folder, name, scene, has_map=True):
    """Returns the run's folder, folder/name, after running the scene if it has no finished run yet.

    With `has_map` the run has a picture of its end.
    """
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
    if done.returncode == STOPPED:  # Ctrl-C also reaches the run
        raise KeyboardInterrupt
    if done.returncode != DONE:
        raise RunFailed(f"{path}: polynya run ended with {done.returncode}\n{done.stderr.strip()}")
    return run
