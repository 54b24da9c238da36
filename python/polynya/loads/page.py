"""loads.html: a page with the gathered loads, the figures and the short tables. It needs no network, but shows the SVG
files of the figures, which must be in its folder."""
import html

from ..page_style import STYLE
from . import words


def shown(value):
    """A cell in HTML: four significant digits of a float, an empty cell for None, and any other value as a text."""
    return html.escape(f"{value:.4g}" if isinstance(value, float) else "" if value is None else str(value))


def cells(row, names):
    """The cells of a row. If the row has a text in its member "refuted", its values are struck through, so that nobody
    takes them for results. The name of the runs and the reason itself stay readable."""
    strike = ("<s>", "</s>") if row.get("refuted") else ("", "")
    return "".join(f"<td>{strike[0] if name not in ('refuted', 'runs') else ''}{shown(row.get(name, ''))}"
                   f"{strike[1] if name not in ('refuted', 'runs') else ''}</td>" for name in names)


def table(heading, rows):
    """A table of rows, which are dicts, with its heading. Its columns are the names in any of the rows, in the order in
    which they first occur, and their heads have spaces instead of underscores. Columns that are empty in all rows are
    left out. `heading` is not escaped, so it must be valid HTML."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    names = [name for name in names if any(row.get(name) not in ("", None) for row in rows)]
    head = "".join(f"<th>{html.escape(name.replace('_', ' '))}</th>" for name in names)
    body = "".join(f"<tr>{cells(row, names)}</tr>" for row in rows)
    return f'<h2>{heading}</h2><div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def fit_rows(estimates):
    """Yields the rows of the table of fits, in words and units for people. `estimates` has (Loads, Estimate) by kind of
    runs. "as one within" is the time within which peaks count as one event, and empty if each counts alone. "refuted"
    is empty unless a fit is refuted."""
    for kind, (_, found) in estimates.items():
        for fit in found.fits:
            tail = fit.tail
            shape = f"{words.shape(tail.shape.value)} ({words.shape(tail.shape.low)} to {words.shape(tail.shape.high)})"
            yield {"runs": kind, "peaks above": words.force(tail.threshold), "number": tail.count,
                   "as one within": f"{fit.events.gap:.3g} s" if fit.events.gap else "", "shape": shape,
                   "scale": words.force(tail.scale.value), "p": f"{fit.goodness_p:.2g}", "refuted": fit.refuted}


def answer_rows(answers, half_width):
    """Yields the rows of the table of return values, in words. `answers` are pairs of a kind of runs and an
    estimate.Answer; a force is "withheld" if there is no value. `half_width` is that of the wanted intervals, as a
    fraction of the value, on which the needed length of record depends."""
    for kind, given in answers:
        yield {"runs": kind, "once in": words.hours(given.period_h), "records": words.plain(given.records),
               "force": words.of_answer(given), "by peaks seen": words.of_seen(given),
               "record needed": words.of_record(given, half_width)}


def page(loads, estimates, answers, options, tables, pictures):
    """Returns the text of the page. `loads` is a gather.Loads, `estimates` and `answers` are as above, and `options`
    those of the command. `tables` are pairs of heading and rows, and stand at the end; tables without rows are left
    out. `pictures` are pairs of file name and description, which is also the caption. Reasons why return values are
    withheld are paragraphs below their table, each with its kind of runs."""
    start = f", from {options.start:g} s of each on" if options.start else ""
    notes = [f"{kind + ': ' if kind else ''}{why}" for kind, (_, found) in estimates.items()
             for why in words.reasons([given for of_kind, given in answers if of_kind == kind], found)]
    withheld = "".join(f"<p>{html.escape(note[:1].upper() + note[1:])}.</p>" for note in notes)
    parts = [
        f"<h1>Loads on {html.escape(loads.ship)}, {html.escape(loads.name)}</h1>",
        f"<p>{html.escape(words.of_loads(loads))}{start}; {loads.left_out} below the least that the runs record are "
        "left out. A peak is the largest force of a contact between two times at which it was below half of it "
        "(docs/run-folder.md).</p>",
        table("Return values", list(answer_rows(answers, options.half_width))),
        withheld, f"<p>{html.escape(words.EXPLAINED)}</p>",
    ]
    parts += [f'<figure><img src="{name}" alt="{html.escape(what)}"><figcaption>{html.escape(what)}</figcaption>'
              "</figure>" for name, what in pictures]
    parts += [table(heading, rows) for heading, rows in tables if rows]
    return (f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Loads on '
            f'{html.escape(loads.ship)}</title><style>{STYLE}</style>'
            + "".join(parts) + "</html>\n")
