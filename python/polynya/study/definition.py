"""Reads the file of a study and checks it (docs/studies.md). Values of scene keys are not checked here; that is done
when the study is planned. Messages state what was found and what is allowed, with line and column of the file."""
import dataclasses
import difflib
import math
import pathlib
import re

from . import draws
from .design import read_design
from .expand import repeats_by_seed
from .located_json import LocatedJson, StudyError, shortened, shown

# Largest seed. With a larger one, two seeds could be the same double, as which the program reads JSON numbers.
LARGEST_SEED = 2**53 - 1
LONGEST_RANGE = 10**6  # largest number of values of a range; a mistyped step would otherwise fill the memory
# Longest file name of a scene [characters], far above real ones. A longer text is refused here, with its place in the
# study; otherwise the file system would refuse it later.
LONGEST_NAME = 1000
# Names of studies and of targets, which are parts of file names and of columns.
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")
# Keys of a study, and below them the keys of its objects `collect`, `collect.management` and `report`. Any other key is
# refused.
KEYS = (
    "name",
    "description",
    "scene",
    "set",
    "grid",
    "paired",
    "design",
    "draw",
    "repetitions",
    "seed",
    "collect",
    "keep",
    "archive",
    "report",
)
COLLECT_KEYS = ("ship", "from_s", "from_m", "loads", "quantiles", "stop_speed_m_per_s", "channel", "time_to",
                "management")
MANAGEMENT_KEYS = ("body", "upstream_m", "near_m", "width_m", "size_m", "from_s")
# Keys of a target of collect.time_to, which must have exactly one of these sets: a line across x or y, a distance
# sailed, or a circle about a point.
TARGETS = ({"x_m"}, {"y_m"}, {"distance_m"}, {"point_m", "within_m"})
REPORT_KEYS = ("against", "means", "exceedance", "group_by", "map", "channels")


@dataclasses.dataclass
class Definition:
    """A valid study. A path is that of a scene key, such as "ice.thickness_m". Cases are all combinations of scenes,
    grid, pairs and draws, repeated with other seeds (expand.py). No path is set twice."""

    file: str  # path of the study's file, as it was given
    name: str  # the study's folder is studies/<name> by default
    folder: pathlib.Path  # folder of the file, to which names of scenes and of the design are relative
    scenes: list  # names of the scenes' files, as in the file
    fixed: dict  # path -> value for every case ("set" of the file)
    grid: dict  # path -> values
    paired: dict  # path -> values, all of one length, including those of the design
    design: dict  # path -> values of a CSV file with one row per case
    draw: dict  # path -> (kind of distribution, its numbers), as for draws.draw()
    draws: int  # number of random draws
    method: str  # "independent" or "latin_hypercube", how draws are spread (draws.uniform_numbers)
    draw_seed: int  # selects the draws; another seed gives other values
    repetitions: int  # number of times that each case is run, with another scene seed each
    seed: int  # scene seed of the first repetition
    collect: dict  # settings of the measures, as in the file; missing ones get their defaults where they are used
    keep: str  # "all", or "summary" to remove the run folder of a finished case
    archive: bool  # whether chunks are packed into one file after their cases have ended
    report: dict  # settings of the report page, as in the file
    source: LocatedJson  # for the places of problems that the check of a scene finds


def read_definition(file, design=None):
    """Reads the study in a JSON file and returns its Definition. `design` is a CSV file that replaces the study's own
    design. Raises StudyError with all problems of the study; if the design has problems, only with those. A file that
    cannot be read is a StudyError (code 5) if it is the study, and an OSError if it is the design."""
    file = pathlib.Path(file)
    return Reader(LocatedJson(file)).read(file, design)


class Reader:
    """Reads one study; each object is used once. Methods that read a value report what is wrong with it and then return
    a valid substitute, so that all problems are found in one go. `path` is the place of a value in the file, as a list
    of keys and indices."""

    def __init__(self, source):
        self.source, self.problems = source, []

    # Returns the Definition, or raises StudyError with all problems that were reported.
    def read(self, file, design=None):
        study = self.source.value
        if not isinstance(study, dict):
            raise StudyError(self.source.problem([], f"found {shown(study)}, allowed: a study (docs/studies.md)"))
        self.unknown_keys(study, KEYS, [])
        self.member(study, "description", str, "")
        draw = self.member(study, "draw", dict, {})
        grid = {path: self.values(spec, ["grid", path]) for path, spec in self.member(study, "grid", dict, {}).items()}
        paired = {
            path: self.values(spec, ["paired", path]) for path, spec in self.member(study, "paired", dict, {}).items()
        }
        designed = self.design(study, file, design)
        scene = study.get("scene")
        scenes = scene if isinstance(scene, list) else [scene]
        for i, name in enumerate(scenes or [None]):
            if not isinstance(name, str) or not name or "\0" in name or len(name) > LONGEST_NAME:
                found = "nothing" if name is None else shown(name)
                self.report(["scene", i], f"found {found}, allowed: a scene's file or a list of them")
        definition = Definition(
            file=str(file),
            name=self.name(study, file),
            folder=file.parent,
            scenes=scenes,
            fixed=self.member(study, "set", dict, {}),
            grid=grid,
            paired={**paired, **designed},
            design=designed,
            draw=self.distributions(draw),
            draws=self.whole(draw, "count", 1, 10**8, 1, ["draw"]),
            method=self.choice(draw, "method", ("independent", "latin_hypercube"), ["draw"]),
            draw_seed=self.whole(draw, "seed", 0, LARGEST_SEED, 1, ["draw"]),
            repetitions=self.whole(study, "repetitions", 1, 10**8, 1),
            seed=self.whole(study, "seed", 0, LARGEST_SEED, 1),
            collect=self.collect(study),
            keep=self.choice(study, "keep", ("all", "summary")),
            archive=self.member(study, "archive", bool, False),
            report=self.report_keys(study),
            source=self.source,
        )
        self.check_lengths(definition)
        self.check_paths(definition)
        if self.problems:
            raise StudyError(self.problems)
        return definition

    def design(self, study, file, given):
        """Returns the values of a design by path, from the file `given`, which is relative to the working directory, or
        otherwise from the study's own design, which is relative to the study's file. The result is empty without a
        design. Raises as read_design() does."""
        named = self.member(study, "design", str, "")
        if not given and not named:
            return {}
        return read_design(given or file.parent / named)

    # Notes a problem of the value at a path, or of the innermost value around it if the file has no such value.
    def report(self, path, message):
        self.problems.append(self.source.problem(path, message))

    # Reports the keys of an object that are not known, with the most similar known key.
    def unknown_keys(self, given, known, path):
        for key in given:
            if key not in known:
                near = difflib.get_close_matches(key[:100], known, 1)
                message = f"found an unknown key, allowed: {', '.join(known)}"
                meant = f'; did you mean "{near[0]}"?' if near else ""
                self.problems.append(self.source.problem([*path, key], message + meant, of_key=True))

    # Returns a member of the object `given`, which must be of the type `kind` (dict, list, str or bool). If it is
    # missing or wrong, the result is the default; only a wrong one is reported. `path` is that of `given`.
    def member(self, given, key, kind, default, path=()):
        value = given.get(key, default)
        if isinstance(value, kind):
            return value
        words = {dict: "an object", bool: "true or false", list: "a list", str: "text"}[kind]
        self.report([*path, key], f"found {shown(value)}, allowed: {words}")
        return default

    # Returns the name of the study, by default the name of its file with a hyphen for each character that is not
    # allowed.
    def name(self, study, file):
        default = re.sub(r"[^A-Za-z0-9._-]", "-", file.stem).lstrip("._-") or "study"
        name = study.get("name", default)
        if isinstance(name, str) and NAME.fullmatch(name):
            return name
        self.report(
            ["name"],
            f"found {shown(name)}, allowed: 1 to 100 letters, digits and . _ -, starting with a letter or digit",
        )
        return default

    # Like member(), for a whole number from `least` to `most`, both allowed. Numbers such as 1e3 are whole too.
    def whole(self, given, key, least, most, default, path=()):
        value = given.get(key, default)
        if isinstance(value, int) and not isinstance(value, bool) and least <= value <= most:
            return value
        self.report([*path, key], f"found {shown(value)}, allowed: a whole number from {least} to {most}")
        return default

    # Like member(), for one of some choices, of which the first is the default.
    def choice(self, given, key, choices, path=()):
        value = given.get(key, choices[0])
        if value not in choices:
            self.report([*path, key], f"found {shown(value)}, allowed: one of {', '.join(choices)}")
            return choices[0]
        return value

    def values(self, spec, path):
        """Returns the values of a key of `grid` or `paired`: a list as it is, or the values of a range, which is an
        object with from, to and either count (with linear or log spacing) or step. Both ends are values of a range with
        a count. The result is [None], or the empty list itself, if the values are wrong, which is reported. `spacing`
        is ignored beside a step."""
        if isinstance(spec, list):
            if not spec:
                self.report(path, "found an empty list, allowed: at least one value")
            return spec
        if not isinstance(spec, dict):
            self.report(path, f"found {shown(spec)}, allowed: a list, or a range of from, to and count or step")
            return [None]
        self.unknown_keys(spec, ("from", "to", "count", "step", "spacing"), path)
        low, high = spec.get("from"), spec.get("to")
        if not draws.is_number(low) or not draws.is_number(high):
            ends = " and ".join(f"{key} {shown(spec.get(key))}" for key in ("from", "to"))
            self.report(path, f"found {ends}, allowed: numbers from and to, and count or step")
            return [None]
        if ("count" in spec) == ("step" in spec):
            self.report(path, "found count and step together or neither, allowed: one of them")
            return [None]
        if "step" in spec:
            return self.stepped(low, high, spec, path)
        count = self.whole(spec, "count", 2, LONGEST_RANGE, 2, path)
        if self.choice(spec, "spacing", ("linear", "log"), path) == "log":
            if low <= 0 or high <= 0:
                self.report(path, "found a range with log spacing that is not positive, allowed: from > 0 and to > 0")
                return [None]
            return self.finite([low * (high / low) ** (i / (count - 1)) for i in range(count)], path)
        return self.finite([low + (high - low) * i / (count - 1) for i in range(count)], path)

    # Returns the values of a range if they are finite. Others result from ends near the largest doubles.
    def finite(self, values, path):
        if all(map(math.isfinite, values)):
            return values
        self.report(path, "found ends that are too far apart, allowed: a range of finite values")
        return [None]

    # Returns the values of a range with a step, which may be negative. `high` is the last value if a whole number of
    # steps leads to it within rounding; otherwise the last value is before it. Values are rounded to 12 decimals, so
    # that 0.1 + 2 · 0.1 is 0.3; a step below 1e-12 would therefore give equal values.
    def stepped(self, low, high, spec, path):
        step = spec["step"]
        if not draws.is_number(step) or step == 0 or not 0 <= (high - low) / step < LONGEST_RANGE:
            allowed = f"a number that leads from {low:g} to {high:g} in less than {LONGEST_RANGE} steps"
            self.report([*path, "step"], f"found {shown(step)}, allowed: {allowed}")
            return [None]
        values = [low + i * step for i in range(math.floor((high - low) / step * (1 + 1e-12) + 1e-9) + 1)]
        return [round(value, 12) for value in values]

    # Returns the valid distributions of `draw` by path, as (kind, numbers); wrong ones are reported and left out.
    def distributions(self, draw):
        self.unknown_keys(draw, ("count", "method", "seed", "of"), ["draw"])
        found = {}
        for path, spec in self.member(draw, "of", dict, {}, ["draw"]).items():
            place = ["draw", "of", path]
            if not isinstance(spec, dict) or len(spec) != 1 or next(iter(spec)) not in draws.KINDS:
                self.report(place, f"found {shown(spec)}, allowed: one of {', '.join(draws.KINDS)} and its numbers")
                continue
            kind, numbers = next(iter(spec.items()))
            fault = (
                draws.fault_of(kind, numbers)
                if isinstance(numbers, dict)
                else f"found {shown(numbers)}, allowed: an object"
            )
            if fault:
                self.report([*place, kind], fault)
            else:
                found[path] = (kind, numbers)
        return found

    # Returns the settings of the measures after checking each of them. Missing ones get their defaults where they are
    # used.
    def collect(self, study):
        collect = self.member(study, "collect", dict, {})
        self.unknown_keys(collect, COLLECT_KEYS, ["collect"])
        for key in ("from_s", "from_m", "stop_speed_m_per_s"):
            if not draws.is_number(collect.get(key, 0)) or collect.get(key, 0) < 0:
                self.report(["collect", key], f"found {shown(collect[key])}, allowed: a number ≥ 0")
        loads = self.member(collect, "loads", list, [], ["collect"])
        if not all(isinstance(name, str) and "_" in name for name in loads):
            allowed = "columns of forces.csv with their units, as surge_from_mooring_N"
            self.report(["collect", "loads"], f"found what is no column, allowed: {allowed}")
        quantiles = self.member(collect, "quantiles", list, [], ["collect"])
        if not all(draws.is_number(q) and 0 < q < 1 for q in quantiles):
            self.report(["collect", "quantiles"], "found what is no probability, allowed: numbers between 0 and 1")
        self.member(collect, "channel", bool, False, ["collect"])
        management = self.member(collect, "management", dict, {}, ["collect"])
        self.unknown_keys(management, MANAGEMENT_KEYS, ["collect", "management"])
        for key in [key for key in management if key in MANAGEMENT_KEYS and key != "body"]:
            if not draws.is_number(management[key]) or management[key] < 0:
                self.report(["collect", "management", key], f"found {shown(management[key])}, allowed: a number ≥ 0")
        self.member(management, "body", str, "", ["collect", "management"])
        self.member(collect, "ship", str, "", ["collect"])
        for name, target in self.member(collect, "time_to", dict, {}, ["collect"]).items():
            self.time_to(name, target, ["collect", "time_to", name])
        return collect

    def time_to(self, name, target, path):
        """Checks a target of collect.time_to: its name, and its line, distance, or position with a radius [m]. `path`
        is that of the target."""
        if not NAME.fullmatch(name):
            found = shown(name)
            allowed = "a name of letters, digits and . _ -, starting with a letter or digit"
            self.problems.append(self.source.problem(path, f"found {found}, allowed: {allowed}", of_key=True))
        if not isinstance(target, dict) or set(target) not in TARGETS:
            found = f"keys {', '.join(map(shortened, target)) or 'none'}" if isinstance(target, dict) else shown(target)
            self.report(path, f"found {found}, allowed: x_m, or y_m, or distance_m, or point_m and within_m")
            return
        for key, value in target.items():
            if key == "point_m":
                if not isinstance(value, list) or len(value) != 2 or not all(map(draws.is_number, value)):
                    self.report([*path, key], f"found {shown(value)}, allowed: two numbers, x and y [m]")
            elif not draws.is_number(value) or (value <= 0 and key in ("within_m", "distance_m")):
                allowed = "a number [m]" if key in ("x_m", "y_m") else "a number > 0 [m]"
                self.report([*path, key], f"found {shown(value)}, allowed: {allowed}")

    # Returns the settings of the report page after checking each of them. Names of measures are not checked, because
    # they are known only after a case has run.
    def report_keys(self, study):
        report = self.member(study, "report", dict, {})
        self.unknown_keys(report, REPORT_KEYS, ["report"])
        for key in ("against", "group_by"):
            self.member(report, key, str, "", ["report"])
        for key, least in (("means", 0), ("exceedance", 0), ("map", 2)):
            names = self.member(report, key, list, [], ["report"])
            if not all(isinstance(name, str) for name in names) or (key in report and least and len(names) != least):
                allowed = "two paths" if key == "map" else "names of measures"
                self.report(["report", key], f"found a list of {len(names)}, allowed: a list of {allowed}")
        self.whole(report, "channels", 0, 100, 12, ["report"])
        return report

    # Reports lists of `paired` of different lengths, draws without a count, and repetitions that would be copies
    # because the study sets the seed itself.
    def check_lengths(self, definition):
        lengths = {path: len(values) for path, values in definition.paired.items()}
        if len(set(lengths.values())) > 1:
            self.report(
                ["design" if definition.design else "paired"],
                f"found lists of {', '.join(f'{n} ({path})' for path, n in lengths.items())}, allowed: lists of one "
                f"length",
            )
        if definition.draw and "count" not in self.source.value["draw"]:
            self.report(["draw"], "found no count, allowed: how many draws")

        if not repeats_by_seed(definition) and definition.repetitions > 1:
            self.report(
                ["repetitions"],
                f"found {definition.repetitions} where the study sets \"seed\" itself, allowed: 1; repetitions would "
                f"be copies",
            )

    # Reports a path that is set twice, or whose part or whole is also set ("ice" beside "ice.thickness_m"), because the
    # order of setting would then decide, and the path "scene", which is no key of a scene.
    def check_paths(self, definition):
        blocks = {
            "set": definition.fixed,
            "grid": definition.grid,
            "paired": {path: values for path, values in definition.paired.items() if path not in definition.design},
            "design": definition.design,
            "draw": definition.draw,
        }
        where, inside = {}, {}  # the block of each path, and for each path a path below it
        for block, paths in blocks.items():
            for path in paths:
                place = {"draw": ["draw", "of", path], "design": ["design"]}.get(block, [block, path])
                if path == "scene":
                    self.report(place, 'found "scene", allowed: a list of scenes as "scene" of the study itself')
                above = [path[: match.start()] for match in re.finditer(r"[.\[]", path)]
                other = next((known for known in [path, *above] if known in where), inside.get(path))
                if other is not None:
                    found = f'what "{where[other]}" varies too ({shortened(other)})'
                    self.report(place, f"found {found}, allowed: each key once")
                where[path] = block
                inside.update(dict.fromkeys(above, path))
