"""Chunks as one file each: millions of small files are what a cluster's file system bears least."""
import io
import json
import os
import shutil
import tarfile

from .case import state_of

ROWS = "results.ndjson"  # first in an archive: the results of its cases, a line each


def pack(study, chunk):
    """Packs a chunk whose cases have all ended, and removes its folders. False where one has not."""
    results = []
    for number in study.cases_of(chunk):
        state, result = state_of(study.case_folder(number))
        if state not in ("finished", "failed"):
            return False
        results.append(json.dumps(result) + "\n")
    archive = study.archive(chunk)
    draft = archive.with_suffix(f".{os.getpid()}.tmp")
    with open(draft, "wb") as file:
        with tarfile.open(fileobj=file, mode="w") as tar:
            text = "".join(results).encode()
            info = tarfile.TarInfo(ROWS)
            info.size = len(text)
            tar.addfile(info, io.BytesIO(text))
            for number in study.cases_of(chunk):
                folder = study.case_folder(number)
                tar.add(folder, arcname=folder.name)
        file.flush()
        os.fsync(file.fileno())
    os.replace(draft, archive)
    remove_folders(study, chunk)
    return True


def remove_folders(study, chunk):
    """Removes a packed chunk's folders; a kill may have left some of them."""
    if study.chunk_size > 1:
        shutil.rmtree(study.chunk_folder(chunk), ignore_errors=True)
    else:
        for number in study.cases_of(chunk):
            shutil.rmtree(study.case_folder(number), ignore_errors=True)


def results_of(study, chunk):
    """The results of a packed chunk's cases, in order."""
    with tarfile.open(study.archive(chunk), "r") as tar:
        first = tar.next()
        if first is None or first.name != ROWS:
            raise ValueError(f"{study.archive(chunk)}: no archive of a study's chunk")
        return [json.loads(line) for line in tar.extractfile(first).read().decode().splitlines()]


def all_states(study):
    """(number, state, result) of every case, in order."""
    for chunk in range(study.chunks):
        if study.archive(chunk).exists():
            for number, result in zip(study.cases_of(chunk), results_of(study, chunk)):
                yield number, result["state"], result
        else:
            for number in study.cases_of(chunk):
                yield number, *state_of(study.case_folder(number))
