"""`polynya study plan`: makes a folder of numbered cases from a study's file, after checking every case.
docs/studies.md explains the file, and folder.py lists the files of the folder.

In this module `lines` are the lines of cases.ndjson, one per case, `old` is the plan that the folder has already, or
None, and `new` the plan that is to be written. Of the options, `design` is the design's file or None, `repetitions` and
`chunk` replace the values of the study unless they are None, `out` is the folder or None, `most` the largest number of
cases, `trial_seconds` the duration of the trial [s] (0: none), `jobs` the number of cases at a time for its estimate,
and with `check_seeds` every case is checked fully."""
import concurrent.futures
import hashlib
import itertools
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time

from ..files import naming, read_text, writing
from ..program import program
from . import trial
from .definition import LARGEST_SEED, read_definition
from .expand import count_cases, expand, repeats_by_seed, varied_paths
from .folder import CASES, FORMAT, INDEX, PLAN, Study, list_of_numbers, read_plan, write_atomically, write_plan
from .located_json import Problem, StudyError, read_json

# Largest number of chunks for which a chunk's size is chosen, because each chunk is one task of a job array. Slurm
# allows MaxArraySize − 1 tasks, by default 1000. A larger number gives job arrays that Slurm may refuse.
MOST_TASKS = 1000
MOST_SHOWN = 20  # number of different problems of cases that are printed; the others are counted


def plan_study(file, options):
    """Plans the study in `file`, or finds that it is planned already. `options` are those of `polynya study plan`.
    Returns the Study. If it raises StudyError, no plan was written, and a folder that was not there is not there. The
    code of the error is 2 for options that do not fit, 3 for a wrong study, and 5 for a folder that cannot be used."""
    if pathlib.Path(file).is_dir():
        raise StudyError(f"{file}: a folder; plan takes the study's JSON file", 2)
    definition = read_definition(file, options.design)
    if options.repetitions:
        if not repeats_by_seed(definition):
            raise StudyError(f"{file}: it sets the seeds itself; with --repetitions cases would be copies", 2)
        definition.repetitions = options.repetitions
    folder = pathlib.Path(options.out or pathlib.Path("studies") / definition.name)
    if count_cases(definition) > options.most:
        message = f"found {count_cases(definition)} cases, allowed: at most {options.most} (--most)"
        raise StudyError(definition.source.problem([], message))
    began = time.perf_counter()
    lines = [json.dumps({"scene": scene, "set": case}) + "\n" for scene, case in expand(definition)]
    expanded = time.perf_counter() - began
    old, was_there = plan_in(folder), folder.exists()
    if was_there and old is None and any(folder.iterdir()):
        raise StudyError(f"{folder}: not empty, and no study is planned there; choose another folder (--out)", 5)
    folder.mkdir(parents=True, exist_ok=True)
    draft = pathlib.Path(tempfile.mkdtemp(prefix=".plan-", dir=folder))
    try:
        return write_study(definition, folder, draft, lines, old, expanded, options)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
        if not was_there and not (folder / PLAN).exists():
            shutil.rmtree(folder, ignore_errors=True)


def write_study(definition, folder, draft, lines, old, expanded, options):
    """Checks the cases, writes the folder and makes the trial; does nothing if the same plan is there. Scenes are
    copied to the folder `draft` first, so that a refused plan replaces nothing. `expanded` is the time that expanding
    took [s], for the message on stderr. Returns the Study. Raises StudyError if a case is wrong or has ended."""
    count, text = len(lines), "".join(lines)
    scenes = copy_scenes(definition, draft, lines)
    new = {
        "format": FORMAT,
        "name": definition.name,
        "source": str(pathlib.Path(definition.file).absolute()),
        **({"design": str(pathlib.Path(options.design).absolute())} if options.design else {}),
        "cases": count,
        "chunk": chunk_size(options.chunk, old, count),
        "archive": definition.archive,
        "keep": definition.keep,
        "set": definition.fixed,
        "scenes": scenes,
        "varied": varied_paths(definition),
        "collect": definition.collect,
        "report": definition.report,
        "inputs": digest_of(draft, scenes),
    }
    if old is not None and is_same(old, new, folder, text):
        return Study(folder, old)
    begins_anew = changes_cases(old, new, folder, text)
    began = time.perf_counter()
    checked = check_cases(definition, draft, scenes, lines, options)
    print(
        f"{count} cases expanded in {expanded:.2g} s; {checked} checked in {time.perf_counter() - began:.2g} s"
        + (", the others differ from them in seeds alone" if checked < count else ""),
        file=sys.stderr,
    )
    if begins_anew:
        shutil.rmtree(folder / "cases", ignore_errors=True)
    shutil.rmtree(folder / "scenes", ignore_errors=True)
    os.rename(draft / "scenes", folder / "scenes")
    write_cases(folder, lines)
    write_plan(folder, new)
    study = Study(folder, new)
    if options.trial_seconds > 0:
        trial.estimate(study, options.trial_seconds, options.jobs)
    return study


def plan_in(folder):
    """The existing plan of a folder, or None. Raises StudyError if it is damaged."""
    return read_plan(folder) if (folder / PLAN).exists() else None


def is_same(old, new, folder, text):
    """Returns True if the old plan has the same contents and cases as the new one, so that nothing need be written. The
    places of the study's file and design, the estimate of the trial and the checksum may differ."""
    same = {"source": None, "design": None, "estimate": None, "crc32": None}
    return {**old, **same} == {**new, **same} and read_text(folder / CASES) == text


def what_differs(plan, members):
    """Says which of the given members differ from those of a plan: "other set, collect"; empty if none does."""
    names = [key for key, value in members.items() if plan.get(key) != value]
    return f"other {', '.join(names)}" if names else ""


def changes_cases(old, new, folder, text):
    """Returns True if the new plan changes cases of the old one, so that those which were begun must be removed. Raises
    StudyError, with code 5, if any case has ended. Not a change are further cases after the old ones (more repetitions
    or draws), and other values of keep and report. False if there is no old plan."""
    if old is None:
        return False
    what = what_differs(old, {key: new[key] for key in ("set", "scenes", "inputs", "collect", "chunk", "archive")})
    if not what and text.startswith(read_text(folder / CASES)):
        return False
    cases = folder / "cases"
    if any(found for pattern in ("*/case.json", "*/*/case.json", "*.tar") for found in cases.glob(pattern)):
        raise StudyError(
            f"{folder}: its cases have run by an earlier plan with {what or 'other cases'}; plan into another folder "
            f"(--out) or remove it",
            5,
        )
    return True


def refuse_changed_file(file, study):
    """Raises StudyError if a study's file now sets or collects something else than the plan that was made from it. Only
    a file that is newer than the plan is compared, with the design of the plan (--design), if it had one. The number of
    repetitions may differ, because --repetitions of `plan` changes it. So cases of one text may be the first ones of
    the other. The code of the error is 5."""
    if os.path.getmtime(file) <= os.path.getmtime(study.folder / PLAN):
        return
    definition = read_definition(file, study.plan.get("design"))
    now = {"set": definition.fixed, "collect": definition.collect, "varied": varied_paths(definition)}
    what = what_differs(study.plan, json.loads(json.dumps(now)))
    lines = "".join(json.dumps({"scene": scene, "set": case}) + "\n" for scene, case in expand(definition))
    planned = read_text(study.folder / CASES)
    if not what and (planned.startswith(lines) or lines.startswith(planned)):
        return
    raise StudyError(
        f"{study.folder}: planned from an earlier text of {file}, which now has {what or 'other cases'}; plan it again "
        f"(polynya study plan {file}), into another folder (--out) if cases have run",
        5,
    )


def chunk_size(given, old, count):
    """Number of cases per chunk: that of --chunk, otherwise that of the old plan if it still gives at most MOST_TASKS
    chunks, otherwise the smallest of 1, 2, 5, 10, 20, … that does. A larger number starts Python less often; a task
    then takes longer."""
    if given:
        return given
    if old is not None and -(-count // old["chunk"]) <= MOST_TASKS:
        return old["chunk"]
    sizes = (digit * 10**power for power in itertools.count() for digit in (1, 2, 5))
    return next(size for size in sizes if size * MOST_TASKS >= count)


def copy_scenes(definition, folder, lines):
    """Copies the scenes, and the floe files that they or the cases name, into `folder`, because a cluster gets only the
    study's folder. Returns the names of the copies of the scenes, relative to `folder`, in the order of the study.
    Raises StudyError if a scene is not JSON or cannot be read. A floe file that is missing is left to the check of the
    cases."""
    names = []
    for i, name in enumerate(definition.scenes):
        source = definition.folder / name
        place = ["scene", i] if len(definition.scenes) > 1 else ["scene"]
        try:
            scene = read_json(source)
        except StudyError as error:
            if error.code == 3:
                raise
            raise StudyError([definition.source.problem(place, problem) for problem in error.problems]) from None
        target = folder / "scenes" / str(i) / source.name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        for file in floe_files(scene, definition, lines):
            if (source.parent / file).is_file():  # the check reports missing files
                (target.parent / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source.parent / file, target.parent / file)
        names.append(str(target.relative_to(folder)))
    return names


def floe_files(scene, definition, lines):
    """Names of the floe files that a scene or a case of the study names (keys `file`), sorted. Absolute names and names
    with ".." are left out: these files are not copied."""
    groups = scene.get("floes") if isinstance(scene, dict) else []
    groups = groups if isinstance(groups, list) else []
    files = {group["file"] for group in groups if isinstance(group, dict) and isinstance(group.get("file"), str)}
    if any(path.endswith(".file") for path in [*definition.grid, *definition.paired, *definition.fixed]):
        for line in [json.dumps({"set": definition.fixed}), *lines]:
            files.update(
                value
                for path, value in json.loads(line)["set"].items()
                if path.endswith(".file") and isinstance(value, str)
            )
    return sorted(file for file in files if not os.path.isabs(file) and ".." not in pathlib.Path(file).parts)


def digest_of(folder, scenes):
    """SHA-256 of the names and contents of the copied scenes and floe files, in hexadecimal digits. The plan keeps it,
    so that a changed scene is noticed when the study is planned again."""
    digest = hashlib.sha256()
    for scene in scenes:
        for path in sorted((folder / scene).parent.rglob("*")):
            if path.is_file():
                digest.update(str(path.relative_to(folder)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def write_cases(folder, lines):
    """Writes cases.ndjson, and cases.index with the start of each line, by which a case is found without reading the
    others: 8 bytes each, little-endian [bytes]. Both files are replaced."""
    offsets, at = [], 0
    for line in lines:
        offsets.append(struct.pack("<Q", at))
        at += len(line.encode())
    write_atomically(folder / CASES, "".join(lines))
    draft = folder / (INDEX + ".tmp")
    with naming(folder / INDEX):
        draft.write_bytes(b"".join(offsets))
        os.replace(draft, folder / INDEX)


def is_seed(path):
    """Returns True for the path of the scene's seed or of a field's seed. Other values of it give other random ice, but
    no other problems of the scene."""
    return path == "seed" or path.endswith(".field.seed")


def check_cases(definition, folder, scenes, lines, options):
    """Checks every case as `polynya run` would. Of cases that differ only in their seeds, the first is checked fully,
    and of the others only that the seeds are allowed, unless --check-seeds is given. Returns the number of full checks.
    Raises StudyError with the problems of all cases (in_words). `folder` has the copied scenes."""
    tasks = [{} for _ in scenes]  # the text of a case -> the numbers of the cases with that text
    problems = {}
    for number, line in enumerate(lines):
        case = json.loads(line)
        values = {**definition.fixed, **case["set"]}
        for path in filter(is_seed, values):
            if (
                not isinstance(values[path], int)
                or isinstance(values[path], bool)
                or not 0 <= values[path] <= LARGEST_SEED
            ):
                problems.setdefault(
                    (path, f"found {values[path]!r}, allowed: an integer ≥ 0, ≤ {LARGEST_SEED}"), []
                ).append(number)
        key = json.dumps(
            values if options.check_seeds else {path: v for path, v in values.items() if not is_seed(path)}
        )
        group = tasks[case["scene"]].setdefault(key, (json.dumps(values), []))
        group[1].append(number)
    for scene, name, groups in zip(scenes, definition.scenes, tasks):
        check_scene(folder / scene, str(definition.folder / name), list(groups.values()), problems)
    if problems:
        raise StudyError(in_words(definition, problems, len(lines)))
    return sum(len(groups) for groups in tasks)


def check_scene(scene, name, groups, problems):
    """Checks a scene's cases with `polynya validate --cases`, in as many processes as there are processors, but at
    least 50 cases each, so that few cases do not start many processes. `name` names the scene in messages, and `groups`
    has (text of the case, numbers of the cases that it stands for). Adds to `problems`: {(path, message): numbers of
    the cases}. Raises StudyError with code 5 if the program fails for another reason than wrong cases."""
    parts = max(1, min(os.cpu_count() or 1, len(groups) // 50))
    with tempfile.TemporaryDirectory() as work, concurrent.futures.ThreadPoolExecutor(parts) as pool:

        def check(part):
            mine = groups[part::parts]
            file = pathlib.Path(work) / f"cases-{part}.ndjson"
            with writing(file) as out:
                out.writelines(text + "\n" for text, _ in mine)
            return (
                mine,
                file,
                subprocess.run(
                    [program(), "validate", scene, "--cases", file, "--json"],
                    capture_output=True,
                    text=True,
                    check=False,
                ),
            )

        for mine, file, ran in pool.map(check, range(parts)):
            if ran.returncode not in (0, 3):
                raise StudyError(f"polynya validate: {ran.stderr.strip() or ran.returncode}", 5)
            for line in ran.stdout.splitlines():
                report = json.loads(line)
                for problem in report["problems"]:
                    place = (
                        ""
                        if problem["file"] == str(file)
                        else f" ({name}:{problem['line']}:{problem['column']})"
                        if problem["file"] == str(scene)
                        else f" ({problem['file']})"
                    )
                    problems.setdefault((problem["path"], problem["message"] + place), []).extend(
                        mine[report["line"] - 1][1]
                    )


def in_words(definition, problems, count):
    """Returns a list with each of the first MOST_SHOWN problems once, at the place in the study that sets its key, with
    the cases that have it; a list of cases longer than 40 characters is cut. `count` is the number of all cases. A last
    line counts the other problems."""
    words = []
    for (path, message), numbers in list(problems.items())[:MOST_SHOWN]:
        numbers = sorted(numbers)
        which = list_of_numbers(numbers)
        shown = which if len(which) <= 40 else which[:40].rsplit(",", 1)[0] + ", …"
        cases = (
            f"all {count} cases"
            if len(numbers) == count and count > 1
            else f"case {shown}"
            if len(numbers) == 1
            else f"{len(numbers)} of {count} cases: {shown}"
        )
        problem = definition.source.problem(place_of(definition, path), message)
        words.append(Problem(problem.file, path, f"{message} [{cases}]", problem.line, problem.column))
    if len(problems) > MOST_SHOWN:
        words.append(f"{definition.file}: {len(problems) - MOST_SHOWN} more problems")
    return words


def place_of(definition, path):
    """Place in the study's file, as a path of keys, at which it sets the scene's key `path`, a part of it, or an object
    that contains it; ["scene"] if it sets none of these, because the problem is then in the scene itself. If several
    fit, the first one in the order below counts."""
    blocks = [
        (["set"], definition.fixed),
        (["grid"], definition.grid),
        (["design"], definition.design),
        (["paired"], definition.paired),
        (["draw", "of"], definition.draw),
    ]
    for place, paths in blocks:
        for known in paths:
            longer, shorter = (known, path) if len(known) >= len(path) else (path, known)
            if longer == shorter or longer.startswith((shorter + ".", shorter + "[")):
                return [*place, known]
    return ["scene"]
