"""Runs of scenes that commands write themselves. Finished runs are kept on the disk, and reused if a command
needs the same scene again."""
import json
import subprocess

from .files import writing
from .study.case import DONE, STOPPED, is_finished


class RunFailed(Exception):
    """Raised if `polynya run` ends with a code other than 0. The text has the scene's file, the code, which is minus
    the number of a signal that killed the program, and the messages of the program."""


def kept_run(program, folder, name, scene, has_map=True):
    """Returns the run folder `folder`/`name` of a scene, given as a dict, and runs the scene if needed. The run is
    reused if it is finished and `folder`/`name`.json, a copy of its scene, has not changed; the version of the program
    that made it is not compared. A run of another scene, an unfinished run or a damaged one is replaced by a new run
    from the start. `program` is the path of polynya. `folder`, a pathlib.Path, must exist. With `has_map` a new run
    gets a picture of its last frame (final.svg or final.png). Raises RunFailed if the program fails, KeyboardInterrupt
    if the run was stopped by a signal, and OSError if the copy cannot be written or the program cannot be started."""
    path, run = folder / (name + ".json"), folder / name
    text = json.dumps(scene, indent=1)
    if is_finished(run) and path.is_file() and path.read_text(encoding="utf-8") == text:
        return run
    # The old run must not count as one of the new scene if the program ends before it replaces the run.
    (run / "summary.json").unlink(missing_ok=True)
    with writing(path) as file:
        file.write(text)
    # Each run uses one thread, because the callers start several runs at the same time. Results do not depend on it.
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
