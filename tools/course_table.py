#!/usr/bin/env python3
"""Writes what the course does to the paper's voyage into docs/paper-comparison.md, from the gathered study of
scenes/studies/sawamura2017-courses.json.

    polynya study run scenes/studies/sawamura2017-courses.json && polynya study gather studies/sawamura2017-courses
    tools/course_table.py studies/sawamura2017-courses
"""
import csv
import pathlib
import statistics
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs/paper-comparison.md"
SECTION = """
## On 41 courses

Half a metre apart, in each scene (`polynya study run scenes/studies/sawamura2017-courses.json`;
`tools/course_table.py`): how many courses end in how many splits, and medians (least–most). The course decides more
than anything else.
"""
BEGIN, END = "<!-- courses: begin -->", "<!-- courses: end -->"
HEAD = [
    "scene",
    "courses",
    "stuck",
    "no split",
    "1 split",
    "2 splits",
    "more",
    "bends",
    "peak resistance, MN",
    "stem at x = 206 m, s",
    "ship at x, m (550 s)",
]


def spread(values, factor=1.0, digits=0):
    """Median (least–most)."""
    if not values:
        return "–"
    low, middle, high = (f"{factor * v:.{digits}f}" for v in (min(values), statistics.median(values), max(values)))
    return f"{middle} ({low}–{high})"


def row_of(scene, cases):
    splits = [int(case["splits"]) for case in cases]
    numbers = lambda name: [float(case[name]) for case in cases if case[name]]
    return [
        scene.removeprefix("sawamura2017-"),
        len(cases),
        sum(case["outcome"] == "stuck" for case in cases),
        splits.count(0),
        splits.count(1),
        splits.count(2),
        sum(n > 2 for n in splits),
        spread(numbers("bends")),
        spread(numbers("resistance_peak_N"), 1e-6, 2),
        spread(numbers("time_to_plates_s")),
        spread(numbers("final_x_m")),
    ]


def main(folder):
    with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
        cases = [row for row in csv.DictReader(file) if row["state"] == "finished"]
    rows = [
        row_of(scene, [case for case in cases if case["scene"] == scene])
        for scene in dict.fromkeys(case["scene"] for case in cases)
    ]
    text = "\n".join(
        [
            "| " + " | ".join(HEAD) + " |",
            "|" + "---|" * len(HEAD),
            *("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows),
        ]
    )
    page = PAGE.read_text(encoding="utf-8")
    if BEGIN not in page:
        page = f"{page.rstrip()}\n{SECTION}\n{BEGIN}\n{END}\n"
    PAGE.write_text(page.split(BEGIN)[0] + BEGIN + "\n\n" + text + "\n\n" + END + page.split(END)[1], encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main(sys.argv[1])
