"""Chart of the ice force on a ship over time in a film: surge and sway in the ship's frame. The whole curve is pale,
and the part up to the present is drawn in full."""
from __future__ import annotations

import numpy

# (column of forces.csv, name in the legend, colour) of the curves. The columns are means over a recording interval.
CURVES = (("surge_N", "surge", "#000000"), ("sway_N", "sway", "#d55e00"))
# Colour of the line at the present (red, green, blue, opacity).
CURSOR = numpy.array([0x00, 0x72, 0xB2, 0xFF], dtype=numpy.uint8)
PALE = 0.22  # opacity of the part of the curve after the present: 0 hides it, 1 draws it in full [-]


def thinned(times, values, bins):
    """Divides the rows into `bins` stretches of equal numbers and keeps at most two points of each, its smallest and
    largest value, in their order. A chart has as many stretches as the picture is wide [px], so no peak is lost. At
    most two rows per stretch are returned unchanged. Returns the kept times and values."""
    if len(times) <= 2 * bins:
        return times, values
    edges = numpy.linspace(0, len(times), bins + 1).astype(int)[:-1]
    stretches = numpy.split(values, edges[1:])
    kept = [start + numpy.sort([part.argmin(), part.argmax()]) for start, part in zip(edges, stretches)]
    indices = numpy.unique(numpy.concatenate(kept))
    return times[indices], values[indices]


def unit_of(largest):
    """Unit for forces up to `largest` [N], and its name: MN from 0.5 MN on, kN from 0.5 kN on, otherwise N. Forces are
    divided by the unit."""
    return next((unit, name) for unit, name in ((1e6, "MN"), (1e3, "kN"), (1.0, "N"))
                if largest >= 0.5 * unit or unit == 1.0)


class History:
    """A chart at the position `place` of a figure, given as [x, y, width, height] in fractions of the figure, with the
    size `font` of text [pt]. `ship` is the name of the ship or structure whose forces are shown, and `look` a
    picture.Look, whose start and end limit the time axis (None: those of the run). A ship without a row of forces.csv
    gets an empty chart. The figure draws the whole curve once; `draw` then changes only pixels, which is fast."""

    def __init__(self, run, ship, look, figure, place, font):
        self.look = look
        columns = run.force_columns
        own = columns["ship"] == ship
        self.start = run.start_time if look.start is None else look.start
        self.end = run.end_time if look.end is None else look.end
        x, y, width, height = place
        left, right, foot, top = 0.075, 0.02, 0.28, 0.14  # in fractions of the chart
        self.axes = figure.add_axes((x + left * width, y + foot * height, (1 - left - right) * width,
                                     (1 - foot - top) * height))
        times = columns["t_s"][own]
        shown = (times >= self.start) & (times <= self.end)
        values = [columns[name][own][shown] for name, _, _ in CURVES]
        largest = max((float(numpy.abs(of).max()) for of in values if len(of)), default=0.0)
        unit, unit_name = unit_of(largest)
        self.axes.margins(y=0.06)
        self.curves = []
        for (_, name, colour), of in zip(CURVES, values):
            at, force = thinned(times[shown], of / unit, look.size[0])
            self.curves += self.axes.plot(at, force, color=colour, linewidth=0.055 * font,
                                          label=name, zorder=2 if name == "surge" else 1)
        if largest < 1.0:  # smaller forces are rounding
            self.axes.set_ylim(-1, 1)
        self._dress(ship, unit_name, font, len(run.ship_names) > 1)

    # Draws axes, labels and legend. `unit` is the name of the forces' unit. The legend names the ship only if the run
    # has others (`has_others`).
    def _dress(self, ship, unit, font, has_others):
        axes, small = self.axes, 0.85 * font
        axes.set_xlim(self.start, self.end)
        axes.axhline(0, color="#888888", linewidth=0.03 * font, zorder=0)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        axes.tick_params(labelsize=small, width=0.05 * font, length=0.25 * font)
        axes.locator_params(axis="y", nbins=4)
        axes.set_xlabel("time [s]", fontsize=small, labelpad=0.1 * font)
        axes.set_ylabel(f"ice force\n[{unit}]", fontsize=small)
        legend = axes.legend(loc="lower right", bbox_to_anchor=(1, 1.06), ncols=2,
                             fontsize=small, frameon=False, borderaxespad=0, borderpad=0,
                             title=f"on {ship}" if has_others else None, title_fontsize=small)
        for line in legend.get_lines():
            line.set_linewidth(0.14 * font)

    def prepare(self, canvas):
        """Stores the chart's pixels with a pale curve. Call it once, after the figure has been drawn on `canvas` and
        before draw()."""
        self._full = numpy.asarray(canvas.buffer_rgba()).copy()
        box = self.axes.get_window_extent()
        rows = len(self._full)
        self._left, self._right = int(numpy.floor(box.x0)), int(numpy.ceil(box.x1))
        self._rows = slice(max(0, rows - int(numpy.ceil(box.y1))), rows - int(numpy.floor(box.y0)))
        inside = self._full[self._rows, self._left + 2 : self._right].astype(float)
        self._pale = (255 - PALE * (255 - inside)).astype(numpy.uint8)

    def draw(self, pixels, time):
        """Makes the curve after `time` [s] pale in `pixels`, and draws a line at that time. `pixels` are those of the
        drawn figure, rows × columns × 4 bytes, and are changed. A time outside of the axis is drawn at its end."""
        share = (time - self.start) / (self.end - self.start) if self.end > self.start else 1.0
        now = self._left + round(min(max(share, 0.0), 1.0) * (self._right - self._left))
        first = max(now, self._left + 2)
        pixels[self._rows, first : self._right] = self._pale[:, first - self._left - 2 :]
        thick = max(1, round(len(pixels) / 480))
        pixels[self._rows, max(self._left, now - thick // 2) : min(now - thick // 2 + thick, pixels.shape[1])] = CURSOR
