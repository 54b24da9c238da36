"""`polynya study report`: statistics, pictures, and one page from which each case can be opened in the player. Needs
numpy, scipy and matplotlib."""
import concurrent.futures
import csv
import html
import os
import subprocess

from .. import statistics
from ..files import writing
from ..page_style import STYLE
from ..program import program
from . import channels, pictures
from .folder import RUN, write_atomically
from .gather import TABLE, gather
from .sample import QUANTILE, choices_of, fits_of, read_sample, refuted

PAGE = "study.html"  # in the study's folder
# Largest number of finished cases for which --players auto makes players, and of rows in the page's table of cases.
# Each player takes time and space; the help of --players states their number. Longer tables make the page slow.
MOST_PLAYERS, MOST_ROWS = 250, 2000
# Half-width of the mean's 95 % interval for which "cases needed" is computed, as a fraction of the mean [-]. Smaller:
# more cases. The column cases_for_5_percent and the page state it in words.
RELATIVE_WIDTH = 0.05


def report(study, players):
    """Gathers the folder.Study, draws, and writes study.html and report/statistics.csv, in place of earlier ones.
    Without a finished case there is no page, and earlier files stay. `players` is the value of --players. Returns the
    exit code of gather, so an incomplete study has a page and a code other than 0."""
    code = gather(study)
    sample = read_sample(study)
    folder = study.folder / "report"
    if sample.size == 0:
        print("report      no case is finished: no page")
        return code
    choices = choices_of(study, sample)
    made = draw(study, sample, choices, folder)
    statistics_rows = statistics_of(sample, choices)
    write_csv(folder / "statistics.csv", statistics_rows)
    make_players(study, sample, players)
    write_atomically(study.folder / PAGE, page(study, sample, choices, made, statistics_rows))
    print(f"page        {study.folder / PAGE}: {len(made)} pictures; report/statistics.csv")
    return code


def draw(study, sample, choices, folder):
    """Draws the pictures of a sample.Sample into the folder, which it makes, as sample.Choices say. Returns (name of
    the SVG, caption) of each. There is no picture of means without a parameter along the x axis, no map without two
    parameters, and none of channels if no run is kept."""
    folder.mkdir(exist_ok=True)
    made = []
    for measure in choices.exceedance:
        made.append(
            (
                pictures.exceedance(sample, measure, choices.group_by, folder),
                f"Probability that a run's {pictures.name_of(measure)} exceeds a value, on Gumbel's probability paper.",
            )
        )
    if choices.against:
        for measure in choices.means:
            made.append(
                (
                    pictures.means(sample, measure, choices.against, choices.group_by, folder),
                    f"Mean of {pictures.name_of(measure)} with its 95 % interval.",
                )
            )
    if choices.map and "outcome" in sample.columns:
        made.append(
            (
                pictures.outcome_map(sample, choices.map, folder),
                "Outcome of most cases. Where it is not the outcome of all, the colour is paler with the share.",
            )
        )
    chosen = channels.choose(study, sample, choices.group_by, choices.channels)
    if chosen:
        words = "The ice at the end of some runs, with the ships and their tracks."
        made.append((channels.draw(study, sample, chosen, choices.group_by, folder), words))
    return made


def statistics_of(sample, choices):
    """A row for each measure and group: mean, quantile, number of cases needed, and the fits of peaks, with their 95 %
    intervals. Values are in the units of the measures. A group with fewer than two values has no row, and only measures
    of choices.exceedance have fits. The number of cases needed is None for a mean of 0."""
    rows = []
    for measure in dict.fromkeys([*choices.means, *choices.exceedance]):
        for value, cases in sample.groups(choices.group_by):
            values = sample.numbers(measure, cases)
            if len(values) < 2:
                continue
            mean, quantile = statistics.mean(values), statistics.quantile(values, QUANTILE)
            bootstrap = statistics.bootstrap_mean(values)
            row = {
                "measure": measure,
                "group": "" if value is None else pictures.in_words(value),
                "cases": len(values),
                "mean": mean.value,
                "mean_low": mean.low,
                "mean_high": mean.high,
                "bootstrap_low": bootstrap.low,
                "bootstrap_high": bootstrap.high,
                "sd": float(values.std(ddof=1)),
                "q99": quantile.value,
                "q99_low": quantile.low,
                "q99_high": quantile.high,
                "cases_for_5_percent": statistics.cases_needed(values, RELATIVE_WIDTH * abs(mean.value))
                if mean.value
                else None,
            }
            rows.append(row)
            if measure in choices.exceedance:
                row.update(fit_columns(values))
    return rows


def fit_columns(values):
    """Columns of the fits to peaks: parameters, tests, and the value that one run of a hundred exceeds. A refuted fit
    has that value under another name, with a note, so that it is not used by mistake. A distribution that cannot be
    fitted has only a note with the reason."""
    columns = {}
    for name, fitted in fits_of(values).items():
        if isinstance(fitted, str):
            columns[f"{name}_note"] = fitted
            continue
        for key, interval in fitted.parameters.items():
            columns.update(
                {
                    f"{name}_{key}": interval.value,
                    f"{name}_{key}_low": interval.low,
                    f"{name}_{key}_high": interval.high,
                }
            )
        columns.update(
            {f"{name}_ks": fitted.ks, f"{name}_ks_p": fitted.ks_p, f"{name}_ad": fitted.ad, f"{name}_ad_p": fitted.ad_p}
        )
        level, why = statistics.level_interval(name, values, 0.01), refuted(fitted)
        if why:
            columns[f"{name}_note"] = why
        prefix = f"{name}_refuted_level" if why else f"{name}_exceeded_by_1_percent"
        columns.update({prefix: level.value, f"{prefix}_low": level.low, f"{prefix}_high": level.high})
    return columns


# Writes rows as CSV, with the columns of all rows in the order in which they first occur; a row without one has an
# empty cell.
def write_csv(path, rows):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with writing(path, newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def make_players(study, sample, players):
    """Makes the players (view.html) of kept runs that have none yet, one per processor at a time. `players` is "all",
    "none", or "auto": only if there are at most MOST_PLAYERS finished cases. Players that exist stay as they are. A
    failure is printed and does not change the exit code."""
    numbers = sample.columns["case"].astype(int).tolist()
    runs = [study.case_folder(n) / RUN for n in numbers]
    wanted = [run for run in runs if (run / "frames.bin").exists() and not (run / "view.html").exists()]
    if players == "none" or (players == "auto" and len(numbers) > MOST_PLAYERS):
        return
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        codes = list(
            pool.map(
                lambda run: subprocess.run([program(), "view", run], capture_output=True, check=False).returncode,
                wanted,
            )
        )
    if any(codes):
        print(
            f"report      {sum(code != 0 for code in codes)} players could not be made; polynya view RUN explains why"
        )


# Returns the text of study.html. `made` is the result of draw(), `rows` that of statistics_of().
def page(study, sample, choices, made, rows):
    text = html.escape
    state = sample.summary
    lines = [
        f"<!doctype html><html lang='en'><meta charset='utf-8'>"
        f"<title>{text(study.plan['name'])}</title><style>{STYLE}</style>",
        f"<h1>{text(study.plan['name'])}</h1>",
        f"<p>{state['cases']} cases: {state['finished']} finished, {state['failed']} failed, {state['unfinished']} "
        f"unfinished, {state['missing']} missing. "
        + ("" if state["is_complete"] else "<b>This page shows a part of the study.</b> ")
        + f"Table: <a href='{TABLE}'>{TABLE}</a>; statistics with their intervals: <a "
        f"href='report/statistics.csv'>statistics.csv</a>.</p>",
    ]
    lines += [
        f"<figure><img src='report/{name}' alt=''><figcaption>{text(caption)}</figcaption></figure>"
        for name, caption in made
    ]
    lines.append(
        "<h2>Statistics</h2><p>Means and 95 % intervals (Student); quantile with the interval of order statistics; "
        "number of cases with which the interval of the mean would be ±5 % of it; peak that one run of a hundred "
        "exceeds by the fit, with its bootstrap interval: struck through where the Kolmogorov–Smirnov or the "
        "Anderson–Darling test refutes the fit (p below 0.05), which then gives no value.</p><div class='wide'>"
        + statistics_table(rows, choices.group_by)
        + "</div>"
    )
    lines.append("<h2>Cases</h2>" + case_table(study, sample))
    if sample.meanings:
        lines.append("<h2>Names</h2><p>Short names of values, by what differs.</p><div class='wide'>"
                     + name_table(sample) + "</div>")
    return "\n".join(lines) + "\n"


# Returns the table of the statistics as HTML, with measures in the units of pictures.label_of. `group_by` is the
# parameter that defines groups; None: there is one group.
def statistics_table(rows, group_by):
    head = [
        "measure",
        pictures.label_of(group_by, is_parameter=True)[0] if group_by else "",
        "cases",
        "mean",
        "99 % quantile",
        "cases for ±5 %",
        "Gumbel 1 %",
        "Weibull 1 %",
    ]
    body = []
    for row in rows:
        label, factor = pictures.label_of(row["measure"])
        cells = [
            label,
            row["group"],
            row["cases"],
            with_interval(row, "mean", factor),
            with_interval(row, "q99", factor),
            row["cases_for_5_percent"],
        ]
        for name in statistics.NAMES:
            cells.append(of_fit(row, name, factor))
        body.append(cells)
    return table(head, body)


def of_fit(row, name, factor):
    """The value that one run of a hundred exceeds by the fit `name`, times `factor`, as HTML. It is struck through,
    with the reason, if the fit is refuted. Without a fit, the reason for that; empty for a measure that is not
    fitted."""
    note = html.escape(row.get(f"{name}_note", ""))
    level = with_interval(row, f"{name}_exceeded_by_1_percent", factor)
    struck = with_interval(row, f"{name}_refuted_level", factor)
    return Raw(f"<s>{html.escape(struck)}</s><br>{note}" if struck else html.escape(level) or note)


def with_interval(row, name, factor):
    """A value of the row with its interval, times `factor`: "1.2 (1.1 – 1.4)"; empty if the row has none."""
    if name not in row:
        return ""
    value, low, high = (pictures.in_words(row[name + side] * factor, 4) for side in ("", "_low", "_high"))
    return f"{value} ({low} – {high})"


def case_table(study, sample):
    """Table of the first MOST_ROWS finished cases as HTML, with their parameters and outcome, and a link to the player
    of each. Without a player there is the command that makes it; without the run folder, the command that runs the case
    again and keeps it."""
    numbers = sample.columns["case"].astype(int).tolist()
    shown = numbers[:MOST_ROWS]
    names = [
        *sample.varied(),
        *(["seed"] if "seed" in sample.columns else []),
        *[n for n in ("outcome", "resistance_mean_N", "resistance_peak_N", "bends", "splits") if n in sample.columns],
    ]
    labels = {name: pictures.label_of(name, is_parameter="." in name) for name in names}
    body = []
    for row, number in enumerate(shown):
        run = study.case_folder(number) / RUN
        page_there = run / "view.html"
        if page_there.exists():
            link = f"<a href='{html.escape(str(page_there.relative_to(study.folder)))}'>play</a>"
        elif run.exists():
            link = f"<code>polynya view {html.escape(str(run))}</code>"
        else:
            link = f"<code>polynya study run {html.escape(str(study.folder))} --case {number} --keep all</code>"
        body.append([number, *(in_unit(sample.columns[name][row], labels[name][1]) for name in names), Raw(link)])
    rest = f"<p>{len(numbers) - len(shown)} more cases are in {TABLE}.</p>" if len(numbers) > len(shown) else ""
    return (
        "<div class='wide'>"
        + table(["case", *(label for label, _ in labels.values()), "player"], body)
        + "</div>"
        + rest
    )


def name_table(sample):
    """Table with the meanings of short names of parameters, as HTML."""
    return table(["parameter", "name", "value"], [[parameter, name, Raw(f"<code>{html.escape(str(value))}</code>")]
                                                  for parameter, of in sample.meanings.items()
                                                  for name, value in of.items()])


def in_unit(value, factor):
    """A value for a table, times `factor`: with six significant digits if the factor is 1, as for parameters, otherwise
    with four."""
    return pictures.in_words(value if factor == 1 else value * factor, 6 if factor == 1 else 4)


class Raw(str):
    """Text that already is HTML, which table() does not escape."""


# Returns a table as HTML from the texts of its head and the rows of values of its body, which are escaped unless Raw.
def table(head, body):
    def cell(tag, value):
        return f"<{tag}>{value if isinstance(value, Raw) else html.escape(str(value))}</{tag}>"

    rows = ["".join(cell("td", value) for value in row) for row in body]
    return (
        "<table><tr>"
        + "".join(cell("th", value) for value in head)
        + "</tr>"
        + "".join(f"<tr>{row}</tr>" for row in rows)
        + "</table>"
    )
