"""Chunks as one file each: millions of small files are what a cluster's file system bears least."""
import io
import json
import os
import shutil
import tarfile

from ..files import naming, open_regular
from .case import is_result, state_of
from .located_json import StudyError

ROWS = "results.ndjson"  # first in an archive: the results of its cases, a line each


def pack(study, chunk):
    """Packs a chunk whose cases have all ended, and removes its folders. False where one has not. Of two processes that
    pack a chunk, the second finds the first one's archive and leaves it."""
    if study.archive(chunk).exists():
        remove_folders(study, chunk)  # a kill may have left some
        return True
    results = []
    for number in study.cases_of(chunk):
        state, result = state_of(study.case_folder(number))
        if state not in ("finished", "failed"):
            return study.archive(chunk).exists()
        results.append(json.dumps(result) + "\n")
    draft = study.archive(chunk).with_suffix(f".{os.getpid()}.tmp")
    try:
        write_archive(study, chunk, draft, "".join(results).encode())
        os.link(draft, study.archive(chunk))  # unlike a rename, never replaces one
    except (FileNotFoundError, FileExistsError):
        if not study.archive(chunk).exists():
            raise
    finally:
        draft.unlink(missing_ok=True)
    remove_folders(study, chunk)
    return True


def write_archive(study, chunk, draft, results):
    with naming(draft), open(draft, "wb") as file:
        with tarfile.open(fileobj=file, mode="w") as tar:
            info = tarfile.TarInfo(ROWS)
            info.size = len(results)
            tar.addfile(info, io.BytesIO(results))
            for number in study.cases_of(chunk):
                folder = study.case_folder(number)
                tar.add(folder, arcname=folder.name)
        file.flush()
        os.fsync(file.fileno())


def unpack(study, chunk):
    """Makes an archive the folders that it was, to run a case of it again."""
    home = study.chunk_folder(chunk) if study.chunk_size > 1 else study.folder / "cases"
    remove_folders(study, chunk)
    draft = study.archive(chunk).with_suffix(f".{os.getpid()}.tmp")
    with open_regular(study.archive(chunk)) as file, tarfile.open(fileobj=file, mode="r:") as tar:
        tar.extractall(draft)
    (draft / ROWS).unlink()
    home.mkdir(exist_ok=True)
    for folder in list(draft.iterdir()):
        os.rename(folder, home / folder.name)
    draft.rmdir()
    study.archive(chunk).unlink()


def chunks_of(study, numbers):
    """The chunks of some cases, in order."""
    return sorted({number // study.chunk_size for number in numbers})


def unpack_to_run(study, numbers, keep, retries_failed):
    """Unpacks the chunks of which a case is to run again: to keep its run, or because it failed."""
    for chunk in chunks_of(study, numbers) if keep == "all" or retries_failed else []:
        if not study.archive(chunk).exists():
            continue
        mine = [result for result in results_of(study, chunk) if result["case"] in numbers]
        is_thinned = keep == "all" and study.plan["keep"] == "summary"
        if is_thinned or any(result["state"] == "failed" for result in mine):
            unpack(study, chunk)


def remove_folders(study, chunk):
    """Removes a packed chunk's folders."""
    if study.chunk_size > 1:
        shutil.rmtree(study.chunk_folder(chunk), ignore_errors=True)
    else:
        for number in study.cases_of(chunk):
            shutil.rmtree(study.case_folder(number), ignore_errors=True)


def results_of(study, chunk):
    """The results of a packed chunk's cases, in order."""
    try:
        with open_regular(study.archive(chunk)) as file, tarfile.open(fileobj=file, mode="r:") as tar:
            first = tar.next()  # extractfile(ROWS) would go through all of it
            text = tar.extractfile(first).read().decode() if first is not None and first.name == ROWS else ""
            results = [json.loads(line) for line in text.splitlines()]
            if len(results) == len(study.cases_of(chunk)) and all(map(is_result, results)):
                return results
    except (tarfile.TarError, ValueError, TypeError, OSError):
        pass
    raise StudyError(f"{study.archive(chunk)}: damaged, or no study's; remove it to run its cases again", 5)


def all_states(study):
    """(number, state, result) of every case, in order."""
    for chunk in range(study.chunks):
        if study.archive(chunk).exists():
            for number, result in zip(study.cases_of(chunk), results_of(study, chunk)):
                yield number, result["state"], result
        else:
            for number in study.cases_of(chunk):
                yield number, *state_of(study.case_folder(number))
