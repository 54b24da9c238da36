"""`polynya loads` (polynya.command starts it)."""
import csv
import html
import pathlib
import sys

from ..command import fail, run

COMMAND = "polynya loads"
DONE, USAGE = 0, 2
STYLE = ("body{font:15px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222;background:#fff}"
         "table{border-collapse:collapse;font-size:13px}td,th{border:1px solid #ccc;padding:2px 8px;text-align:right}"
         "img{max-width:100%}.wide{overflow-x:auto}")


def rows_of(columns):
    """Columns of equal length as rows."""
    names = list(columns)
    return [dict(zip(names, values)) for values in zip(*(columns[name] for name in names))]


def fit_rows(loads, least):
    from . import estimate
    for of, _, fit in estimate.fits(loads, least):
        row = {"of": of, "fit": fit.name, "values": fit.size}
        for name, interval in fit.parameters.items():
            row.update({name: interval.value, f"{name}_low": interval.low, f"{name}_high": interval.high})
        yield {**row, "ks": fit.ks, "ks_p": fit.ks_p, "ad": fit.ad, "ad_p": fit.ad_p}


def tables_of(loads, options):
    """(file's name, heading, rows)."""
    from . import estimate
    return [
        ("peaks.csv", "", rows_of(loads.peaks)),
        ("panels.csv", "Panels", estimate.panels(loads)),
        ("exceedance.csv", "", rows_of(estimate.exceedance(loads))),
        ("fits.csv", "Fits", list(fit_rows(loads, options.least))),
        ("returns.csv", "Return values", estimate.returns(loads, options.returns, options.least)),
    ]


def names_of(rows):
    return list(dict.fromkeys(name for row in rows for name in row))


def write_csv(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, names_of(rows), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def shown(value):
    return html.escape(f"{value:.4g}" if isinstance(value, float) else str(value))


def html_table(heading, rows):
    names = names_of(rows)
    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    body = "".join("<tr>" + "".join(f"<td>{shown(row.get(name, ''))}</td>" for name in names) + "</tr>" for row in rows)
    return f'<h2>{heading}</h2><div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def page_of(loads, options, tables, pictures):
    """loads.html: what was gathered, the figures, the tables that are short."""
    reach = f", {loads.kilometres:.4g} km" if loads.kilometres > 1e-6 else ""
    parts = [
        f"<h1>Loads on {html.escape(loads.ship)}, {html.escape(loads.name)}</h1>",
        f"<p>{len(loads.forces)} peaks in {len(loads.cases)} run{'s' if len(loads.cases) > 1 else ''}: "
        f"{loads.hours:.4g} h{reach}, from {options.start:g} s "
        f"of each on; {loads.left_out} below the runs' limits are left out. A peak is the largest force of a contact "
        f"between two times at which it was "
        "below half of it (docs/run-folder.md); what the numbers are, docs/loads.md.</p>",
    ]
    parts += [f'<figure><img src="{name}" '
              f'alt="{html.escape(words)}"><figcaption>{html.escape(words)}</figcaption></figure>'
              for name, words in pictures]
    parts += [html_table(heading, rows) for _, heading, rows in tables if heading and rows]
    return (f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Loads on '
            f'{html.escape(loads.ship)}</title><style>{STYLE}</style>'
            + "".join(parts) + "</html>\n")


def report(options):
    from polynya.errors import InputError
    from polynya.figures.page import STYLES, Page, save

    from . import gather, pictures

    try:
        loads = gather(options.folder, options.ship, options.start, options.panel)
    except InputError as error:
        return fail(COMMAND, error, USAGE)
    out = pathlib.Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    tables, drawn = tables_of(loads, options), []
    for name, _, rows in tables:
        if rows:
            write_csv(out / f"loads-{name}", rows)
            print(out / f"loads-{name}", flush=True)
    style = STYLES[options.style]
    for name, words, figure in pictures.all_of(loads, Page(style), options.least):
        if figure is None:
            continue
        for path in save(figure, str(out / f"loads-{name}"), dict.fromkeys([*options.format, "svg"]), style.dots):
            print(path, flush=True)
        drawn.append((f"loads-{name}.svg", words))
    (out / "loads.html").write_text(page_of(loads, options, tables, drawn), encoding="utf-8")
    print(out / "loads.html")
    return DONE


def main(words=None):
    from .options import command_line

    return report(command_line().parse_args(words))


if __name__ == "__main__":
    sys.exit(run("loads", main))
