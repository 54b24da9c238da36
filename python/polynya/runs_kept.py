"""Runs of scenes that commands make: finished ones are kept, and used again where the scene is the same."""
import json
import subprocess

from .study.case import DONE, STOPPED, summary_of


class RunFailed(Exception):
    pass


def kept_run(program, folder, name, scene):
    """The run's folder, folder/name; of a run that is there already, at once."""
    path, run = folder / (name + ".json"), folder / name
    text = json.dumps(scene, indent=1)
    summary = summary_of(run)
    if summary and summary["finished"] and path.exists() and path.read_text(encoding="utf-8") == text:
        return run
    path.write_text(text, encoding="utf-8")
    done = subprocess.run(
        [program, "run", path, "--out", run, "--overwrite", "--progress", "none", "--threads", "1"],
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
