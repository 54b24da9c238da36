"""Processor time and mean surge of nine shipped scenes at several places each, and how two ways of stepping compare.

The two ways are two programs, or one program with two settings, as two ticks. Each is given a label.

Usage: python3 bench/step_places.py run PROGRAM --label NAME --results FILE [--places N] [--only SCENE[,SCENE]]
                                        [--set KEY=VALUE]... [--scenes DIR]
       python3 bench/step_places.py table FILE LABEL [LABEL...]

`run` runs each scene at each place by PROGRAM on one thread and appends a line of JSON to FILE as soon as a run is
known. It may be interrupted: a label's runs that FILE has are not repeated. `--set` goes on to PROGRAM.

A place is one of seven shifts of the ship, or of the structure where there is no ship, 3.1 m apart to its side. The
next seven places have the same shifts and the next seed of the scene, and so on. Level ice is the same at all shifts.
So in level-brash and level-plate the thickness differs as well, by up to 3 %, and the mean surge is brought back to the
scene's thickness by h^1.8.

The mean surge is that by contact of the first ship, after 15 s and after a tenth of the run; of a structure it is the
length of the mean force. The processor's time is that of the run in user and system mode, start-up and all, without
the check by `inspect --check` that follows it. Unsolved steps are `unconverged_steps`; their share is that of the
ticks, each of which may be several time steps (`time_steps`, which programs before checkpoint version 22 do not have).

`table` prints these by scene and label, as Markdown, and each label against the first one over the places that both
have. Differences are in standard errors of both means, as if independent: what a place does to both makes them too
small. The sum of their squares is chi-square with as many degrees of freedom as there are scenes only where the errors
are exact. With errors of n places each difference is Student's, and large ones are more frequent. So there is a second
p value, of the differences brought to a normal distribution by Wallace's formula for 2 (n - 1) degrees of freedom.
"""

import argparse
import collections
import csv
import json
import math
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
UNTIL = {"field-10000": 500, "field-100000": 300, "pack-power-law": 100, "cylinder-shear": 150, "level-brash": 200,
         "pressure": 110, "mixed-ice": 80, "route-in-ice": 280, "level-plate": 200}  # [s]
LEVEL_ICE = ("level-brash", "level-plate")
SHIFTS = 7
APART = 3.1  # shifts [m]
THICKNESS = 0.5  # thickness in a scene that gives none [m]
THICKNESS_SPREAD = 0.03
THICKNESS_POWER = 1.8
STRING_OR_COMMENT = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*')


def read_scene(file):
    """Reads a scene; its comments are passed over."""
    return json.loads(STRING_OR_COMMENT.sub(lambda found: found[1] or "", file.read_text(encoding="utf-8")))


def place_of(name, scene, place):
    """Returns what a place sets in the scene, its shift [m], and its factor on the thickness."""
    moved = "ships" if "ships" in scene else "structures"
    seed, number = divmod(place, SHIFTS)
    shift = APART * (number - (SHIFTS - 1) / 2)
    settings = [f"{moved}[0].position_m[1]={scene[moved][0]['position_m'][1] + shift:.10g}"]
    if seed > 0:
        settings.append(f"seed={scene.get('seed', 1) + seed}")
    factor = 1.0
    if name in LEVEL_ICE:
        factor += THICKNESS_SPREAD * ((2 * number + 1) / SHIFTS - 1)
        settings.append(f"ice.thickness_m={factor * scene.get('ice', {}).get('thickness_m', THICKNESS):.10g}")
    return settings, shift, factor


def children_time():
    """Returns the processor's time of all children that have ended [s]; os.times() has it to 10 ms only."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def mean_surge(run, until, is_structure):
    """Returns the mean resistance by contact of the first hull, or the length of a structure's mean force [N]."""
    after = max(15, 0.1 * until)
    with (run / "forces.csv").open(encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    rows = [row for row in rows if row["ship"] == rows[0]["ship"] and float(row["t_s"]) > after]
    surge, sway = (statistics.fmean(float(row[key]) for row in rows) for key in ("surge_N", "sway_N"))
    return math.hypot(surge, sway) if is_structure else -surge


def checked(program, run):
    """Returns the exit code and the last line of `inspect --check`, and whether they call the run sound."""
    done = subprocess.run([program, "inspect", run, "--check", "--progress", "none"], capture_output=True, text=True,
                          check=False)
    line = (done.stdout.strip() or done.stderr.strip() or " ").splitlines()[-1]
    return {"check_exit": done.returncode, "check_line": line, "sound": done.returncode == 0 and line == "sound"}


def measured(given, name, scene, place):
    """Runs one scene at one place and returns its row; a run that failed has its exit code and last line only."""
    settings, shift, factor = place_of(name, scene, place)
    row = {"label": given.label, "scene": name, "place": place, "shift_m": round(shift, 6),
           "thickness_factor": factor, "set": given.set}
    options = [word for setting in settings + given.set for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(folder) / "run"
        before = children_time()
        done = subprocess.run([given.program, "run", given.scenes / f"{name}.json", *options, "--until",
                               str(UNTIL[name]), "--out", run, "--overwrite", "--no-map", "--progress", "none",
                               "--threads", "1"], capture_output=True, text=True, check=False)
        row |= {"run_exit": done.returncode, "processor_s": round(children_time() - before, 4)}
        if done.returncode != 0:
            return row | {"error": (done.stderr.strip() or " ").splitlines()[-1], "sound": False}
        summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
        surge = mean_surge(run, UNTIL[name], "ships" not in scene) / factor**THICKNESS_POWER
        return row | {"surge_N": surge, "step_s": summary["step_s"], "steps": summary["steps"],
                      "time_steps": summary.get("time_steps"),
                      "unsolved": summary["counts"]["unconverged_steps"]} | checked(given.program, run)


def rows_by_key(file):
    """Returns the rows of a result file by label, scene and place; there may be no such file yet."""
    if not file.exists():
        return {}
    rows = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines() if line.strip()]
    return {(row["label"], row["scene"], row["place"]): row for row in rows}


def run_all(given):
    """Runs what the result file does not have yet, place by place, so that all scenes are known early."""
    known = rows_by_key(given.results)
    for row in known.values():
        if row["label"] == given.label and row["set"] != given.set:
            raise SystemExit(f"{given.results} has {given.label} by --set {row['set']}: give another --label")
    names = given.only.split(",") if given.only else list(UNTIL)
    if unknown := [name for name in names if name not in UNTIL]:
        raise SystemExit(f"no such scene here: {', '.join(unknown)}; there are {', '.join(UNTIL)}")
    scenes = {name: read_scene(given.scenes / f"{name}.json") for name in names}
    for place in range(given.places):
        for name, scene in scenes.items():
            if (given.label, name, place) in known:
                continue
            line = json.dumps(measured(given, name, scene, place))
            with given.results.open("a", encoding="utf-8") as file:
                file.write(line + "\n")
            print(line, flush=True)


def mean_and_error(rows):
    """Returns the mean surge and its standard error over the rows [N]; of one row there is no error."""
    surges = [row["surge_N"] for row in rows]
    error = statistics.stdev(surges) / math.sqrt(len(surges)) if len(surges) > 1 else math.nan
    return statistics.fmean(surges), error


def chi_square_survival(value, degrees):
    """Returns the probability that chi-square with that many degrees of freedom exceeds the value.

    It is exact: Q(a + 1, x) = Q(a, x) + x^a e^-x / gamma(a + 1) leads from Q(1/2, x) = erfc(sqrt(x)), or from
    Q(1, x) = e^-x, to Q(degrees / 2, value / 2).
    """
    half, order = value / 2, 0.5 if degrees % 2 else 1
    probability = math.erfc(math.sqrt(half)) if degrees % 2 else math.exp(-half)
    while order < degrees / 2:
        probability += half**order * math.exp(-half) / math.gamma(order + 1)
        order += 1
    return probability


def normal_of_student(value, degrees):
    """Returns the size of the normal deviate that is as probable as that of Student's, by Wallace's formula."""
    return math.sqrt(degrees * math.log1p(value**2 / degrees)) * (8 * degrees + 1) / (8 * degrees + 3)


def print_scenes(found, labels):
    """Prints the table of scenes and labels."""
    print("| scene | label | tick, s | processor, s | mean surge, kN | s.e., % | unsolved steps | of ticks, % "
          "| sound |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in UNTIL:
        for label in labels:
            rows = list(found[label, name].values())
            done = [row for row in rows if "surge_N" in row]
            if not done:
                if rows:
                    print(f"| {name} | {label} | | | | | | | 0 of {len(rows)} |")
                continue
            mean, error = mean_and_error(done)
            ticks = "/".join(f"{step:g}" for step in sorted({row["step_s"] for row in done}))
            unsolved = sum(row["unsolved"] for row in done)
            print(f"| {name} | {label} | {ticks} | {statistics.median(row['processor_s'] for row in done):.2f} "
                  f"| {mean / 1e3:.2f} ± {error / 1e3:.2f} | {100 * error / mean:.1f} | {unsolved} "
                  f"| {100 * unsolved / sum(row['steps'] for row in done):.3g} "
                  f"| {sum(row['sound'] for row in rows)} of {len(rows)} |")


def compared(of_first, of_label):
    """Compares two labels' rows of a scene over the places that both have; without such places returns None.

    There are the number of places, the ratio of times, the change of the mean, and that in standard errors, which is
    NaN where there is no error.
    """
    places = sorted(place for place in of_first.keys() & of_label.keys()
                    if "surge_N" in of_first[place] and "surge_N" in of_label[place])
    if not places:
        return None
    (first, first_error), (label, label_error) = (mean_and_error([rows[i] for i in places])
                                                  for rows in (of_first, of_label))
    times = [sum(rows[i]["processor_s"] for i in places) for rows in (of_first, of_label)]
    error = math.hypot(first_error, label_error)
    return len(places), times[1] / times[0], label / first - 1, (label - first) / error if error > 0 else math.nan


def print_against(found, first, label):
    """Prints a table of a label against the first one, and under it what all scenes say together."""
    print(f"\n| {label} against {first} | places | time's ratio | mean surge differs, % | in s.e. |")
    print("|---|---|---|---|---|")
    ratios, squares, normal_squares = [], [], []
    for name in UNTIL:
        outcome = compared(found[first, name], found[label, name])
        if not outcome:
            continue
        places, ratio, change, deviate = outcome
        print(f"| {name} | {places} | {ratio:.3f} | {100 * change:+.1f} | {deviate:+.2f} |")
        ratios.append(ratio)
        if not math.isnan(deviate):
            squares.append(deviate**2)
            normal_squares.append(normal_of_student(deviate, 2 * (places - 1))**2)
    if ratios:
        print(f"\nGeometric mean of the ratios of time over {len(ratios)} scenes: "
              f"{statistics.geometric_mean(ratios):.3f}.")
    if squares:
        print(f"Chi-square {sum(squares):.2f} over {len(squares)} scenes, "
              f"p = {chi_square_survival(sum(squares), len(squares)):.2g}; of Student's differences "
              f"{sum(normal_squares):.2f}, p = {chi_square_survival(sum(normal_squares), len(squares)):.2g}.")


def print_tables(given):
    """Prints the tables of a result file."""
    found = collections.defaultdict(dict)
    for (label, name, place), row in rows_by_key(given.results).items():
        found[label, name][place] = row
    labels = [given.label, *given.labels]
    print_scenes(found, labels)
    for label in given.labels:
        print_against(found, given.label, label)


def main():
    """Reads the command line and does what it asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    run = commands.add_parser("run", help="run the scenes")
    run.add_argument("program")
    run.add_argument("--label", required=True)
    run.add_argument("--results", type=pathlib.Path, required=True)
    run.add_argument("--places", type=int, default=7)
    run.add_argument("--only", help="scenes, by commas")
    run.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    run.add_argument("--scenes", type=pathlib.Path, default=ROOT / "scenes")
    run.set_defaults(command=run_all)
    table = commands.add_parser("table", help="print the tables of a result file")
    table.add_argument("results", type=pathlib.Path)
    table.add_argument("label")
    table.add_argument("labels", nargs="*")
    table.set_defaults(command=print_tables)
    given = parser.parse_args()
    given.command(given)


if __name__ == "__main__":
    main()
