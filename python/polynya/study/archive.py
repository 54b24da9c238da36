"""Packs chunks of cases into one file each, because a cluster's file system is slow with millions of small files. A
study with `"archive": true` does so. An archive is a tar file with the results of its cases and their folders. It is
not compressed, so that its first member can be read without the rest."""
import io
import json
import os
import shutil
import tarfile

from ..files import naming, open_regular
from .case import is_result, state_of
from .located_json import StudyError

# First member of an archive: the results of its cases, one JSON object per line. It is first so that results_of() can
# read it without the rest of the archive.
ROWS = "results.ndjson"


def pack(study, chunk):
    """Packs a chunk whose cases have all finished or failed, and removes its folders. Returns True if the chunk is
    packed afterwards, and False if one of its cases has not ended. Each `polynya study run` calls it at its end for the
    chunks of its cases. If two processes pack the same chunk, the archive of the first is kept. Raises OSError if the
    archive cannot be written, also on a file system without hard links; the folders then stay."""
    if study.archive(chunk).exists():
        remove_folders(study, chunk)  # a killed process may have left folders
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
        os.link(draft, study.archive(chunk))  # unlike a rename, this never replaces an archive
    except (FileNotFoundError, FileExistsError):
        if not study.archive(chunk).exists():
            raise
    finally:
        draft.unlink(missing_ok=True)
    remove_folders(study, chunk)
    return True


def write_archive(study, chunk, draft, results):
    """Writes the archive of a chunk to the file `draft`, so that it is on the disk when the function returns. `results`
    are the bytes of ROWS."""
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
    """Restores the folders of an archive, so that its cases can run again, and removes the archive. They are extracted
    to a draft folder first. A kill on the way therefore leaves the archive or all folders, and perhaps the draft. There
    is no lock: no other process may run cases of the chunk or pack it meanwhile. Archives are trusted: their members
    are not checked."""
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
    """The numbers of the chunks that have some of these cases, in ascending order."""
    return sorted({number // study.chunk_size for number in numbers})


def unpack_to_run(study, numbers, keep, retries_failed):
    """Unpacks those chunks of the cases `numbers` that must run again: all if `keep` (the option --keep of the command)
    is "all" and the study kept only summaries, because their run folders are gone; otherwise those with a failed case,
    if `retries_failed` (--retry-failed) is true. The other cases of such a chunk are unpacked with it."""
    is_thinned = keep == "all" and study.plan["keep"] == "summary"
    for chunk in chunks_of(study, numbers) if is_thinned or retries_failed else []:
        if not study.archive(chunk).exists():
            continue
        if is_thinned or any(number in numbers for number in failed_in(study, chunk)):
            unpack(study, chunk)


def remove_folders(study, chunk):
    """Removes the folders of a chunk's cases, which its archive contains. Folders that are not there are no error."""
    if study.chunk_size > 1:
        shutil.rmtree(study.chunk_folder(chunk), ignore_errors=True)
    else:
        for number in study.cases_of(chunk):
            shutil.rmtree(study.case_folder(number), ignore_errors=True)


def failed_in(study, chunk):
    """Numbers of the failed cases of a packed chunk. Raises StudyError as results_of() does."""
    results = zip(study.cases_of(chunk), results_of(study, chunk))
    return [number for number, result in results if result["state"] == "failed"]


def results_of(study, chunk):
    """The results of the cases of a packed chunk, in order of their numbers. Raises StudyError (code 5) if the archive
    is damaged or has another number of results."""
    try:
        with open_regular(study.archive(chunk)) as file, tarfile.open(fileobj=file, mode="r:") as tar:
            first = tar.next()  # extractfile(ROWS) would read the whole archive
            text = tar.extractfile(first).read().decode() if first is not None and first.name == ROWS else ""
            results = [json.loads(line) for line in text.splitlines()]
            if len(results) == len(study.cases_of(chunk)) and all(map(is_result, results)):
                return results
    except (tarfile.TarError, ValueError, TypeError, OSError):
        pass
    raise StudyError(f"{study.archive(chunk)}: damaged, or no study's; remove it to run its cases again", 5)


def all_states(study):
    """Yields (number, state, result) of every case, in order of the numbers. States and results are those of
    case.state_of()."""
    for chunk in range(study.chunks):
        if study.archive(chunk).exists():
            for number, result in zip(study.cases_of(chunk), results_of(study, chunk)):
                yield number, result["state"], result
        else:
            for number in study.cases_of(chunk):
                yield number, *state_of(study.case_folder(number))
