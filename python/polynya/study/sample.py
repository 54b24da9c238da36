"""A gathered study as columns of its finished cases, grouped by parameters. Needs numpy."""
import dataclasses
import functools

import numpy

from .. import files, statistics
from ..errors import FolderError
from ..naming import names_of
from .gather import TABLE, read_summary

MOST_GROUPS = 8
LEAST_FIT = 10  # least number of cases in a group for a fit
QUANTILE = 0.99
REFUTED = 0.05  # a fit with a smaller p value is refuted


@dataclasses.dataclass
class Sample:
    """Columns of the finished cases by name: numbers if all values are numbers, otherwise texts; NaN means no value."""

    columns: dict
    parameters: list
    summary: dict
    meanings: dict = dataclasses.field(default_factory=dict)  #: parameter -> {short name: value in the table}

    @property
    def size(self):
        return len(self.columns["case"])

    def values_of(self, name):
        """The different values of a parameter, in order."""
        return sorted(set(self.columns[name].tolist()))

    def varied(self):
        """Parameters with more than one value, without seeds."""
        return [
            name
            for name in self.parameters
            if name in self.columns and name != "seed" and len(self.values_of(name)) > 1
        ]

    def groups(self, by):
        """(value, cases) for each value of a parameter; all cases if `by` is empty."""
        if by is None:
            return [(None, numpy.ones(self.size, dtype=bool))]
        return [(value, self.columns[by] == value) for value in self.values_of(by)]

    def numbers(self, name, cases):
        values = self.columns[name][cases]
        return values[numpy.isfinite(values)]

    def has_numbers(self, name):
        return name in self.columns and self.columns[name].dtype.kind == "f"


def read_sample(study):
    cells, summary = files.read_cells(study.folder / TABLE), read_summary(study.folder)
    kept = [row for row, state in enumerate(cells["state"]) if state == "finished"]
    columns = files.Columns({name: column([of[row] for row in kept]) for name, of in cells.items()}, cells.path)
    if not kept:
        return Sample({"case": numpy.array([])}, summary["parameters"], summary, {})
    if columns["case"].dtype.kind != "f" or not numpy.isin(columns["case"], range(study.count)).all():
        raise FolderError(f"{cells.path}: a case that the study does not have: polynya study gather {study.folder} "
                          f"writes it again")
    meanings = {}
    for name in summary["parameters"]:
        if columns[name].dtype.kind != "f":
            columns[name], meanings[name] = named(columns[name])
    return Sample(columns, summary["parameters"], summary, {name: of for name, of in meanings.items() if of})


def named(values):
    """A column of texts in which short names replace objects and long texts, and {short name: the value}."""
    names = names_of(values.tolist())
    return (numpy.array([names[value] for value in values.tolist()]),
            {name: value for value, name in names.items() if name != value})


def column(values):
    if all(value == "" or files.is_number(value) for value in values):
        return numpy.array([float(value) if value else numpy.nan for value in values])
    return numpy.array(values)


@dataclasses.dataclass
class Choices:
    """Settings of a report, from the study's "report" or, if they are missing there, from the parameters that vary."""

    against: str | None
    means: list
    exceedance: list
    group_by: str | None
    map: tuple | None
    channels: int


def choices_of(study, sample):
    given, varied = study.plan["report"], sample.varied()
    numeric = [name for name in varied if sample.has_numbers(name)]
    against = given.get("against", numeric[0] if numeric else None)
    few = [name for name in varied if 1 < len(sample.values_of(name)) <= MOST_GROUPS]
    group_by = given.get("group_by", few[0] if few else None)
    cells = [name for name in varied if len(sample.values_of(name)) <= 60]
    over = tuple(given["map"]) if "map" in given else tuple(cells[:2]) if len(cells) >= 2 else None
    known = lambda names: [name for name in names if sample.has_numbers(name)]
    return Choices(
        against if against in sample.columns else None,
        known(given.get("means", ["resistance_mean_N", "mean_speed_m_per_s", "channel_width_m"])),
        known(given.get("exceedance", ["resistance_peak_N"])),
        group_by if group_by in sample.columns else None,
        over if over and all(name in sample.columns for name in over) else None,
        given.get("channels", 12),
    )


def refuted(fit):
    """Reason why a fit gives no rarely exceeded value; empty if it gives one."""
    p = min(fit.ks_p, fit.ad_p)
    return f"refuted: p {p:.2g}" if p < REFUTED else ""


def fits_of(values, seed=0):
    """Gumbel's and Weibull's distributions fitted to a group's peaks, or the reason why there are none."""
    return fits_of_bytes(numpy.asarray(values, dtype=float).tobytes(), seed)


@functools.lru_cache(maxsize=256)  # pictures and tables use the same fits
def fits_of_bytes(data, seed):
    values, found = numpy.frombuffer(data), {}
    for name in statistics.NAMES:
        try:
            if len(values) < LEAST_FIT:
                raise ValueError(f"{len(values)} cases, fewer than {LEAST_FIT}")
            found[name] = statistics.fit(name, values, seed=seed)
        except ValueError as error:
            found[name] = str(error)
    return found
