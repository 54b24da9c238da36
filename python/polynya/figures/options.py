"""The words of `polynya figures`, which app/figures.cpp has with their help."""
from __future__ import annotations

import argparse

from .loads import CHOICES
from .page import FORMATS, STYLES

FIGURES = ("floes", "loads", "motion", "sizes", "energy")


def numbers(text):
    return [float(part) for part in text.split(",")]


def command_line():
    parser = argparse.ArgumentParser(prog="polynya figures", description="Draw a run, or several side by side, for print (docs/figures.md).")
    parser.add_argument("runs", nargs="+", metavar="RUN", help="run folders")
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(FIGURES), metavar="LIST", help="of " + ",".join(FIGURES))
    parser.add_argument("--at", type=numbers, default=[], metavar="S,S,...", help="instants of the maps [s]")
    parser.add_argument("--from", dest="start", type=float, metavar="S", help="draw from this time on [s]")
    parser.add_argument("--until", dest="end", type=float, metavar="S", help="draw up to this time [s]")
    parser.add_argument("--window", type=numbers, metavar="X0,Y0,X1,Y1", help="the part of the world that the maps show [m]")
    parser.add_argument("--load", choices=CHOICES, default="true", help="which load; the true force of the ice if not given")
    parser.add_argument("--label", action="append", default=[], metavar="NAME", help="names of the runs, once for each")
    parser.add_argument("--title", metavar="TEXT", help='title of the figures instead of their own; "" for none')
    parser.add_argument("--style", choices=STYLES, default="two-columns", help="what for; two-columns if not given")
    parser.add_argument("--width-mm", type=float, metavar="MM", help="width on paper; the style's if not given")
    parser.add_argument("--format", type=lambda text: text.split(","), default=list(FORMATS), metavar="LIST", help="of " + ",".join(FORMATS))
    parser.add_argument("--out", default="", metavar="DIR", help="folder of the figures; the first run's if not given")
    return parser
