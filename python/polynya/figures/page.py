"""The page of a figure. It is as wide as requested, as tall as heading, panels and legend need, and nothing extends
beyond its edge."""
from __future__ import annotations

import dataclasses
import os
from typing import Optional

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from polynya.files import naming

from . import options

MM = 1 / 25.4  # one millimetre in inches, the unit of matplotlib's figures [inch]
POINT = 25.4 / 72  # one point, the unit of font sizes [mm]
# Empty margin around a figure at Style.scale 1, and between its parts [mm]. Larger: less room for panels; smaller: text
# may touch the edge.
MARGIN = 1.5
# Distance between lines of text, as a multiple of the font size; smaller: letters may touch; larger: less room is left.
LINE = 1.3


@dataclasses.dataclass(frozen=True)
class Style:
    """Style for one use of a figure. Its sizes are those on paper."""

    width: float  #: width of the figure [mm]
    tallest: float  #: height to which figures keep if they can, with heading and legend [mm]
    small: float  #: size of numbers at ticks and of notes [pt]
    text: float  #: size of labels, legends, captions and titles of panels [pt]
    title: float  #: size of the title, which is bold [pt]
    dots: int  #: dots per inch of a PNG, and of pixels within SVG and PDF
    maps: int  #: number of maps of one run if no times are given

    @property
    def scale(self):
        """Factor for lines, marks, gaps and heights of panels. It is 1 for the text of 8 pt of a paper, so sizes in the
        code are those of a paper."""
        return self.text / 8


# Styles for one column and for the whole width of a page of a paper, and for slides, which have larger text.
ONE_COLUMN = Style(85, 235, 7, 8, 9, 300, 4)
TWO_COLUMNS = Style(170, 235, 7, 8, 9, 300, 4)
SLIDES = Style(300, 165, 14, 16, 18, 200, 2)
STYLES = dict(zip(options.STYLES, (ONE_COLUMN, TWO_COLUMNS, SLIDES)))


@dataclasses.dataclass(frozen=True)
class Page:
    """Style of a figure, and what replaces parts of it. Each page can be used for several figures."""

    style: Style = TWO_COLUMNS  #: sizes and width, if nothing replaces them
    given_width: Optional[float] = None  #: replaces the width of the style [mm]
    title: Optional[str] = None  #: replaces the figure's own title; empty: neither title nor caption

    @property
    def width(self):
        """Width on paper [mm]."""
        return self.given_width or self.style.width

    def columns_for(self, panels, least=46.0):
        """Number of columns for `panels` panels. Each is at least `least` [mm] times the scale wide, and there are no
        more columns than the number of rows needs, so that rows are nearly full. It is at least 1."""
        most = max(1, min(panels, int(self.width / (least * self.style.scale))))
        rows = -(-panels // most)
        return -(-panels // rows)

    def row_height(self, rows, wanted):
        """Height of a row of panels with its text [mm]: `wanted` times the scale, or less, so that all rows fit below
        the style's largest height together with 32 mm of heading and legend. It is never below 15 mm times the
        scale."""
        scale = self.style.scale
        return max(15 * scale, min(wanted * scale, (self.style.tallest - 32 * scale) / rows))

    def settings(self):
        """Settings of matplotlib for this page, by name. Letters are outlines in SVG, so that they look the same
        everywhere, and the fixed salt makes the same figure give the same bytes."""
        style, scale = self.style, self.style.scale
        return {
            "font.family": "DejaVu Sans",
            "font.size": style.text,
            "axes.titlesize": style.text,
            "axes.labelsize": style.text,
            "xtick.labelsize": style.small,
            "ytick.labelsize": style.small,
            "legend.fontsize": style.text,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.linewidth": 0.6 * scale,
            "xtick.major.width": 0.6 * scale,
            "ytick.major.width": 0.6 * scale,
            "xtick.minor.width": 0.4 * scale,
            "ytick.minor.width": 0.4 * scale,
            "xtick.major.size": 2.5 * scale,
            "ytick.major.size": 2.5 * scale,
            "xtick.minor.size": 1.5 * scale,
            "ytick.minor.size": 1.5 * scale,
            "axes.titlepad": 3 * scale,
            "axes.labelpad": 2 * scale,
            "lines.linewidth": 1.0 * scale,
            "hatch.linewidth": 0.5 * scale,
            "axes.formatter.use_mathtext": True,
            "axes.formatter.limits": (-4, 6),
            "axes.unicode_minus": True,
            "pdf.fonttype": 42,
            "svg.fonttype": "path",
            "svg.hashsalt": "polynya",
        }


class Sheet:
    """A figure while it is drawn, with the settings of its page. Within `with Sheet(page, title, caption) as sheet`,
    make panels with `sheet.panels`, draw in them, then call `finish`, which returns the figure. The page's settings
    hold for matplotlib as a whole within the block, and the former ones are restored after it. Figures are made without
    pyplot, so they need not be closed. A caption is left out if the page has its own title."""

    def __init__(self, page, title="", caption=""):
        self.page = page
        self._settings = matplotlib.rc_context(page.settings())
        self._own = (title, caption)

    def __enter__(self):
        self._settings.__enter__()
        self.figure = Figure(figsize=(self.page.width * MM, 4), dpi=300)
        FigureCanvasAgg(self.figure)
        return self

    def __exit__(self, *error):
        return self._settings.__exit__(*error)

    def panels(self, rows, columns, **more):
        """Makes axes in rows and columns and returns them as an array of that shape. `more` are arguments of
        matplotlib's subplots(). The size of tick labels is set here, because matplotlib would read the setting only
        when it draws, after the sheet has ended."""
        grid = self.figure.subplots(rows, columns, squeeze=False, **more)
        for axes in grid.flat:
            axes.tick_params(which="both", labelsize=self.page.style.small)
        return grid

    def width_of(self, words, size, weight="normal"):
        """Width of a text of a size [pt] on paper [mm]."""
        text = self.figure.text(0, 0, words, fontsize=size, fontweight=weight)
        width = text.get_window_extent().width / self.figure.dpi / MM
        text.remove()
        return width

    def wrapped(self, words, size, width, weight="normal"):
        """Breaks a text into lines no wider than `width` [mm] in a font of a size [pt], and returns them: at spaces,
        otherwise after hyphens and underscores, otherwise anywhere. A blank text gives no line. A single letter may be
        wider."""
        lines, line = [], ""
        for part in parts_of(words):
            if self.width_of((line + part).rstrip(), size, weight) <= width:
                line += part
                continue
            if line:
                lines.append(line.rstrip())
            while self.width_of(part.rstrip(), size, weight) > width and len(part) > 1:
                fits = next((n for n in range(len(part) - 1, 1, -1) if self.width_of(part[:n], size, weight) <= width),
                            1)
                lines.append(part[:fits])
                part = part[fits:]
            line = part.lstrip() if lines else part
        return lines + [line.rstrip()] if line.strip() else lines

    def title_panel(self, axes, number, panels, words, width):
        """Sets the title of the panel with this number from 0, of `panels`, in lines no wider than `width` [mm]. If
        there are several panels it begins with a letter, as (a). Each line of `words` is broken on its own. Without
        words and with one panel there is no title."""
        letter = f"({letters(number)}) " if panels > 1 else ""
        lines = [line for title in (letter + words).split("\n")
                 for line in self.wrapped(plain(title), self.page.style.text, width)]
        if lines:
            axes.set_title("\n".join(lines), loc="left", fontsize=self.page.style.text)

    def label_y(self, axes, words, height):
        """Adds a label of the y axis in lines no longer than the height of a panel with its text [mm]."""
        axes.set_ylabel("\n".join(self.wrapped(words, self.page.style.text, height - 6 * self.page.style.scale)))

    def finish(self, panels_height, handles=(), notes=(), is_snug=False):
        """Places heading and legend around the panels, makes the page as tall as needed, and returns the figure.
        `panels_height` is the height of the panels with their labels [mm]; with `is_snug` it is reduced by their blank
        part, which maps of fixed shape leave. `handles` are the entries of the legend, and `notes` paragraphs of small
        text at the bottom."""
        self._decorate(handles, notes)
        self._place(panels_height)
        if is_snug:
            self._place(panels_height - self._blank(panels_height))
        self.figure.set_layout_engine("none")
        for axes in self.figure.axes:  # the last bits of the layout solver differ between calls
            axes.set_position([round(edge, 6) for edge in axes.get_position().bounds])
        return self.figure

    def _decorate(self, handles, notes):
        """Makes the text around the panels: heading, notes and legend. `_place` positions it, as their height is only
        then known."""
        style, room = self.page.style, self.page.width - 2 * MARGIN * self.page.style.scale
        bold = lambda size: "bold" if size == style.title else "normal"
        self._above = [self.figure.text(0, 0, words, fontsize=size, fontweight=bold(size), in_layout=False)
                       for words, size in self._heading(room)]
        self._below = [self.figure.text(0, 0, line, fontsize=style.small, in_layout=False)
                       for note in notes for line in self.wrapped(note, style.small, room)]
        self._key, self._key_height = self._legend(handles, room)

    def _place(self, panels_height):
        """Sets the size of the figure and the positions of texts, legend and panels, for panels of a height [mm]. It
        may be called again."""
        page, style, figure = self.page, self.page.style, self.figure
        margin = MARGIN * style.scale
        head = sum(text.get_fontsize() for text in self._above) * POINT * LINE + (margin if self._above else 0)
        foot = len(self._below) * style.small * POINT * LINE + (margin if self._below else 0)
        low = margin + foot + self._key_height + (2 * margin if self._key else 0)
        height = low + panels_height + head + margin
        figure.set_size_inches(page.width * MM, height * MM)
        y = height - margin
        for text in self._above:
            y -= text.get_fontsize() * POINT * LINE
            text.set_position((margin / page.width, (y + 0.3 * text.get_fontsize() * POINT) / height))
        for i, text in enumerate(reversed(self._below)):
            text.set_position((margin / page.width, (margin + (i * LINE + 0.3) * style.small * POINT) / height))
        if self._key:
            self._key.set_bbox_to_anchor((0.5, (margin + foot) / height))
        if figure.get_layout_engine() is None:
            figure.set_layout_engine("constrained")
        rect = (margin / page.width, low / height, 1 - 2 * margin / page.width, panels_height / height)
        pad = 0.02 * style.scale  # [inch]
        figure.get_layout_engine().set(rect=rect, w_pad=pad, h_pad=pad, wspace=0.03, hspace=0.03)
        for _ in range(2):  # tick labels change with the size of the panels
            figure.get_layout_engine().execute(figure)

    def _blank(self, panels_height):
        """Height by which the panels can be reduced [mm]: their blank part without a small gap that stays."""
        boxes = [axes.get_tightbbox(self.figure.canvas.get_renderer()) for axes in self.figure.axes]
        filled = max(box.y1 for box in boxes) - min(box.y0 for box in boxes)
        return panels_height - filled / self.figure.dpi / MM - 1.5 * self.page.style.scale

    def _heading(self, width):
        """Lines of title and caption with their sizes [pt], no wider than `width` [mm]. There are no lines if the
        page's title is an empty text."""
        style, given = self.page.style, self.page.title
        if given == "":
            return []
        title, caption = (given, "") if given is not None else self._own
        lines = [(line, style.title) for line in self.wrapped(plain(title), style.title, width, "bold")]
        return lines + [(line, style.text) for line in self.wrapped(plain(caption), style.text, width)]

    def _legend(self, handles, width):
        """Makes a legend with as many columns as fit into `width` [mm]. Returns it and its height [mm], or None and 0
        without handles."""
        if not handles:
            return None, 0
        style = self.page.style
        swatch = 2.6 * style.text * POINT
        for handle in handles:
            handle.set_label("\n".join(self.wrapped(handle.get_label(), style.text, width - swatch - 2)))
        for rows in range(1, len(handles) + 1):
            columns = -(-len(handles) // rows)
            legend = self.figure.legend(handles=list(handles), loc="lower center",
                                        ncols=columns, frameon=False, borderaxespad=0, borderpad=0.1,
                                        handlelength=1.8, handletextpad=0.5, columnspacing=1.3,
                                        labelspacing=0.35, bbox_to_anchor=(0.5, 0))
            box = legend.get_window_extent(self.figure.canvas.get_renderer())
            if box.width / self.figure.dpi / MM <= width or columns == 1:
                return legend, box.height / self.figure.dpi / MM
            legend.remove()


def set_log(axis, low, high):
    """Makes an axis (axes.xaxis or axes.yaxis) logarithmic for values from low to high, both above 0, with plain
    numbers. The fewer decades there are, the more numbers each has. The limits of the axis are not set."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 20 * low else (1, 3) if high < 100 * low else (1,)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def parts_of(words):
    """Divides a text at spaces and after hyphens and underscores; each part keeps its separator."""
    part = ""
    for before, letter in zip(" " + words, words):
        if (before == " " and letter != " " and part.strip()) or (before in "-_" and part[:-1].strip()):
            yield part
            part = ""
        part += letter
    yield part


def plain(words):
    """Escapes a text for matplotlib, so that a dollar is shown as such."""
    return words.replace("$", r"\$")


def in_words(value):
    """A number with four significant digits as a text, with powers of ten as superscripts, such as 1.5 · 10⁶, for
    numbers from 10⁴ on and below 10⁻⁴."""
    mantissa, _, power = f"{value:.4g}".replace("-", "−").partition("e")
    raised = power.lstrip("+").replace("−0", "−").lstrip("0").translate(str.maketrans("−0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return mantissa + (" · 10" + raised if power else "")


def letters(number):
    """The letter of a panel by its number from 0: a … z, aa, ab …"""
    return (letters(number // 26 - 1) if number >= 26 else "") + chr(ord("a") + number % 26)


def save(figure, stem, formats, dots=300):
    """Writes a figure to stem.svg and so on, for each of `formats` (svg, pdf, png), and yields each path after its file
    was written; nothing is written until the caller takes the paths. `dots` per inch are those of PNGs and of pixels
    within the other formats. Each file is written completely or not at all, and replaces a file or link of that name.
    The same figure gives the same bytes, so dates and the name of the software are left out. Raises KeyError for
    another format, and OSError, with the file's name, if a file cannot be written; the files before it stay."""
    for suffix in formats:
        path = f"{stem}.{suffix}"
        draft = f"{path}.{os.getpid()}.tmp"
        nothing = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {"Software": None}}[suffix]
        try:
            with matplotlib.rc_context({"font.family": "DejaVu Sans", "pdf.fonttype": 42,
                                        "svg.fonttype": "path", "svg.hashsalt": "polynya"}):
                with naming(path):
                    figure.savefig(draft, format=suffix, dpi=dots, metadata=nothing)
            os.replace(draft, path)
        finally:
            if os.path.exists(draft):
                os.remove(draft)
        yield path
