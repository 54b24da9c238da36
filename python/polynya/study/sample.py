"""A gathered study as columns of its finished cases, for the statistics and pictures of `polynya study report`. Needs
numpy and scipy."""
import dataclasses
import functools

import numpy

from .. import files, statistics
from ..errors import FolderError
from ..naming import names_of
from .gather import TABLE, read_summary

# Largest number of values that a parameter may have for cases to be grouped by it if the study does not name one
# (`report.group_by`); pictures have as many colours. Larger: further groups are grey, without a fit and without a
# legend entry of their own (pictures.GREY).
MOST_GROUPS = 8
# Least number of cases in a group for a fit of its peaks. With fewer, its parameters and its tests say little. Larger:
# smaller groups get the reason in place of a fit.
LEAST_FIT = 10
# Probability of the quantile of a measure over cases in the page and in report/statistics.csv. Its columns are named
# q99 after this value; another value needs other names.
QUANTILE = 0.99
# A fit is refuted if the p value of one of its tests is smaller [-]. Its value that is rarely exceeded is then struck
# through on the page. A larger limit also refutes more fits that are right.
REFUTED = 0.05


@dataclasses.dataclass
class Sample:
    """The finished cases of a study."""

    columns: dict  #: name -> array: numbers, with NaN for no value, if all values are numbers, otherwise texts
    parameters: list  #: names of the columns of the varied parameters
    summary: dict  #: contents of gather.json
    meanings: dict = dataclasses.field(default_factory=dict)  #: parameter -> {short name: value in the table}

    @property
    def size(self):
        return len(self.columns["case"])

    def values_of(self, name):
        """The different values of a parameter, sorted, as numbers or texts. Raises FolderError if the table has no such
        column."""
        return sorted(set(self.columns[name].tolist()))

    def varied(self):
        """Parameters with more than one value, without the scene's seed."""
        return [
            name
            for name in self.parameters
            if name in self.columns and name != "seed" and len(self.values_of(name)) > 1
        ]

    def groups(self, by):
        """[(value, cases)] for each value of the parameter `by`, where `cases` is a mask of the cases with that value.
        If `by` is None, one group with the value None and all cases."""
        if by is None:
            return [(None, numpy.ones(self.size, dtype=bool))]
        return [(value, self.columns[by] == value) for value in self.values_of(by)]

    def numbers(self, name, cases):
        """Values of a column of numbers in the cases of a mask, without those that are missing; may be empty. The
        column must have numbers (has_numbers())."""
        values = self.columns[name][cases]
        return values[numpy.isfinite(values)]

    def has_numbers(self, name):
        """Returns True if there is a column with this name and it has numbers."""
        return name in self.columns and self.columns[name].dtype.kind == "f"


def read_sample(study):
    """Reads the Sample of a gathered study; it has only an empty column "case" if no case is finished. Parameters that
    are texts or objects get short names. Raises FolderError if table.csv or gather.json is damaged or missing, or if
    the table has a case that the study does not have."""
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
    """Replaces objects and long texts of a column by short names (names_of). Returns the column, and {short name: the
    value} for those that were replaced."""
    names = names_of(values.tolist())
    return (numpy.array([names[value] for value in values.tolist()]),
            {name: value for value, name in names.items() if name != value})


def column(values):
    """Converts cells of a table to an array: numbers if all are numbers or empty (NaN), otherwise texts. One cell with
    a text makes the whole column texts. A column of only empty cells is numbers, all NaN."""
    if all(value == "" or files.is_number(value) for value in values):
        return numpy.array([float(value) if value else numpy.nan for value in values])
    return numpy.array(values)


@dataclasses.dataclass
class Choices:
    """Settings of a report, from the study's "report" or, if they are missing there, from the parameters that vary."""

    against: str | None  #: parameter along the x axis of means; None: no picture of means
    means: list  #: measures whose means are drawn
    exceedance: list  #: measures whose exceedance is drawn, and to which distributions are fitted
    group_by: str | None  #: parameter of whose values each has a line in the pictures; None: all cases are one group
    map: tuple | None  #: two parameters, over which the outcomes are drawn; None: no map
    channels: int  #: largest number of cases whose channel is drawn


def follows(columns, name, others):
    """Returns True if a parameter has only one value for each combination of the `others`, because it was set together
    with them (`paired` of a study). It then divides the cases no further. `columns` maps names of parameters to their
    values in all cases; `others` are such names. Values are compared as texts."""
    values = {}
    for value, *key in zip(*([str(cell) for cell in columns[of]] for of in (name, *others))):
        if values.setdefault(tuple(key), value) != value:
            return False
    return True


def independent(sample, names):
    """The names of parameters without those that follow from one before them."""
    kept = []
    for name in names:
        if not any(follows(sample.columns, name, [other]) for other in kept):
            kept.append(name)
    return kept


def choices_of(study, sample):
    """The Choices of a study. By default means are drawn over the first varied parameter that is a number, or else over
    the first one, groups are formed by the first one with at most MOST_GROUPS values, and the map is over the first two
    with at most 60 values, so that its cells stay large enough to see. A parameter that follows from an earlier one
    (`paired`) is passed over. What the study's "report" names takes precedence over these defaults. Names that the
    table does not have are left out, and so are measures without numbers."""
    given = study.plan["report"]
    named = [given[key] for key in ("group_by", "against") if given.get(key) in sample.columns]
    varied = independent(sample, [*dict.fromkeys([*named, *sample.varied()])])
    numeric = [name for name in varied if sample.has_numbers(name)]
    against = given.get("against", numeric[0] if numeric else varied[0] if varied else None)
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
    """Says that a Fit is refuted, with the smaller p value of its two tests (Kolmogorov and Smirnov's, and Anderson and
    Darling's); empty if it is not."""
    p = min(fit.ks_p, fit.ad_p)
    return f"refuted: p {p:.2g}" if p < REFUTED else ""


def fits_of(values, seed=0):
    """{"gumbel": …, "weibull": …} of the distributions fitted to a group's peaks: each a Fit, or a text with the reason
    why there is none: fewer than LEAST_FIT values, or values that the distribution cannot have. `seed` selects the
    bootstrap samples; with the same one the result is the same."""
    return fits_of_bytes(numpy.asarray(values, dtype=float).tobytes(), seed)


# Pictures and tables use the same fits, each of which needs a bootstrap. The values are given as bytes, because the
# keys of the cache must be hashable. 256 groups are kept; with more in a page some are fitted again, which takes
# longer.
@functools.lru_cache(maxsize=256)
def fits_of_bytes(data, seed):
    """The result of fits_of for the bytes of an array of floats."""
    values, found = numpy.frombuffer(data), {}
    for name in statistics.NAMES:
        try:
            if len(values) < LEAST_FIT:
                raise ValueError(f"{len(values)} cases, fewer than {LEAST_FIT}")
            found[name] = statistics.fit(name, values, seed=seed)
        except ValueError as error:
            found[name] = str(error)
    return found
