#!/usr/bin/env python3
"""The figures of docs/theory, drawn from the laws that they show. Needs matplotlib (Debian's python3).

    /usr/bin/python3 tools/theory_figures.py [NAME...]          into theory-NAME.svg of docs/images
    /usr/bin/python3 tools/theory_figures.py --check            compares the files with what it draws
Exit code of --check: 1 if a file differs, 77 if another version of matplotlib drew it.
"""
import io
import pathlib
import sys

import matplotlib
matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.patches import Arc, FancyBboxPatch, Polygon  # noqa: E402

IMAGES = pathlib.Path(__file__).resolve().parent.parent / "docs/images"
ICE, WATER, HULL, EDGE, FORCE, SOFT = "#f4f1e6", "#bcd7e8", "#444b54", "#55606b", "#c8501e", "#9aa4ad"
plt.rcParams.update({"font.size": 9, "svg.hashsalt": "polynya", "mathtext.fontset": "dejavusans", "axes.linewidth": .8})


def sketch(size, x, y, axes=None):
    figure, axes = (None, axes) if axes else plt.subplots(figsize=size)
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.axis("off")
    return figure, axes


def arrow(axes, start, end, label="", color=FORCE, at=None, both=False, **text):
    axes.annotate("", end, start, arrowprops={"arrowstyle": "<|-|>" if both else "-|>", "color": color, "lw": 1.3,
                                              "shrinkA": 0, "shrinkB": 0})
    place = np.add(start, end) / 2 if at is None else at
    axes.text(*place, label, color=color, **{"ha": "center", "va": "center", **text})


def shape(axes, points, color, **options):
    axes.add_patch(Polygon(points, closed=True, fc=color, **{"ec": EDGE, "lw": 1, **options}))


def contact():
    """Overlap in plan, and the facet and forces in section."""
    figure, (plan, side) = plt.subplots(1, 2, figsize=(7.2, 3))
    sketch(None, (-3, 3.2), (-2.4, 2.2), plan)
    shape(plan, [(-3, .3), (3.2, .3), (3.2, -2.2), (-3, -2.2)], ICE)
    shape(plan, [(-2.2, 2), (0, -1), (2.2, 2)], HULL, alpha=.85)
    shape(plan, [(-.953, .3), (0, -1), (.953, .3)], FORCE, alpha=.55, ec="none")
    plan.plot([-.953, .953], [.3, .3], color="k", lw=2)
    arrow(plan, (-.953, .55), (.953, .55), "$w$", "w", (0, .8), both=True)
    arrow(plan, (1.35, .3), (1.35, -1), r"$\xi$", "k", (1.65, -.35), both=True)
    plan.text(0, -.1, "$S$", ha="center", va="center")
    plan.plot([.953, 1.5], [.3, .3], color="k", lw=.6)
    plan.plot([0, 1.5], [-1, -1], color="k", lw=.6)
    arrow(plan, (0, -1.05), (0, -2), "$\\mathbf{n}$", at=(.3, -1.7))
    plan.text(-2.6, -1.9, "floe", color=EDGE)
    plan.text(0, 1.5, "hull", color="w", ha="center")
    plan.set_title("In plan: the overlap", fontsize=9)
    sketch(None, (-3, 3.4), (-2.6, 2), side)
    slope = np.tan(np.radians(35))
    shape(side, [(-3, -2.6), (3.4, -2.6), (3.4, -.2), (-3, -.2)], WATER, ec="none")
    shape(side, [(0, .3), (3.4, .3), (3.4, -1.2), (-1.5 * slope, -1.2)], ICE)
    x = [1 + (.3 - 2) * -slope, 1 + (.3 + 2.6) * -slope]
    shape(side, [(-3, 2), (1 + 1.7 * slope, 2), (1, .3), (1 - 1.5 * slope, -1.2), (x[1], -2.6), (-3, -2.6)],
          HULL, alpha=.85)
    side.plot([1, 1 - 1.5 * slope], [.3, -1.2], color=FORCE, lw=3)
    middle = np.array([1 - .75 * slope, -.45])
    normal = np.array([np.cos(np.radians(35)), -np.sin(np.radians(35))])
    arrow(side, middle, middle + 1.7 * normal, "$F_n=\\sigma_c A_c$", at=middle + 1.7 * normal + (-.6, -.35), ha="left")
    arrow(side, middle, middle + (1.4, 0), "$H$", at=middle + (1.65, .05))
    arrow(side, middle, middle + (0, -.98), "$V$", at=middle + (-.02, -1.2))
    side.plot([1, 1], [.3, 1.8], "w--", lw=.8)
    side.add_patch(Arc((1, .3), 2, 2, theta1=55, theta2=90, color="w"))
    side.text(1.3, 1.55, r"$\theta_s$", color="w", ha="center")
    arrow(side, (2.9, .3), (2.9, -1.2), "$h$", "k", (3.15, -.45), both=True)
    side.set_title("In section: facet and forces", fontsize=9)
    return figure


def wedge():
    """The wedge at a contact and the cusp that breaks off."""
    figure, axes = sketch((5, 3), (-5, 5), (-3.6, 2.4))
    shape(axes, [(-5, .9), (-2.2, .5), (0, 0), (2.4, .4), (5, 1.1), (5, -3.6), (-5, -3.6)], ICE)
    shape(axes, [(-2, 2.4), (0, -.25), (2, 2.4)], HULL, alpha=.85)
    angle = np.linspace(0, 2 * np.pi, 15)[:-1] + .2
    ring = np.c_[2.3 * np.cos(angle), 2.3 * np.sin(angle)]
    axes.add_patch(Polygon(ring, closed=True, fc="none", ec=FORCE, lw=1.2, ls="--"))
    inside = [(-2.26, .51), *[tuple(p) for p in ring if p[1] < .25], (2.27, .38), (0, 0)]
    inside = [inside[0], *sorted(inside[1:-2], key=lambda p: np.arctan2(p[1], p[0]) % (2 * np.pi)), *inside[-2:]]
    shape(axes, inside, FORCE, alpha=.18, ec="none")
    arrow(axes, (0, 0), tuple(ring[9]), "$R$", "k", (-1.15, -1.1))
    axes.add_patch(Arc((0, 0), 7, 7, theta1=-188, theta2=8, color=SOFT, ls=":"))
    axes.text(2.6, -2.75, r"$0.3\,l$", color=EDGE)
    axes.plot([0, 0], [0, -3.2], color="k", lw=.7, ls="-.")
    axes.add_patch(Arc((0, 0), 2.2, 2.2, theta1=-90, theta2=9.5, color="k"))
    axes.text(.95, -.9, r"$\theta_w$", ha="center")
    axes.text(-1.2, -1.95, "cusp", color=FORCE)
    axes.text(-4.7, -3.3, "floe", color=EDGE)
    axes.text(0, 1.7, "hull", color="w", ha="center")
    return figure


def radial():
    """Cracks that are tried from the contacts of a bow in a channel's head."""
    figure, axes = sketch((5.6, 3.2), (-2, 10), (-3.4, 3.4))
    shape(axes, [(-2, -3.2), (9.4, -3.2), (9.8, 2.6), (5, 3.2), (-2, 2.9), (-2, 1),
                 (0, 1), (1.6, 0), (0, -1), (-2, -1)], ICE)
    shape(axes, [(-2, .9), (-.2, .9), (1.7, 0), (-.2, -.9), (-2, -.9)], HULL, alpha=.85)
    corners = [(-2, -3.2), (9.4, -3.2), (9.8, 2.6), (5, 3.2), (-2, 2.9)]

    def reach(mouth, angle):
        direction = np.array([np.cos(angle), np.sin(angle)])
        lengths = []
        for a, b in zip(corners, corners[1:] + corners[:1]):
            side = np.subtract(b, a)
            matrix = np.c_[direction, -side]
            if np.linalg.matrix_rank(matrix) < 2:  # the side lies along the crack
                continue
            t, s = np.linalg.solve(matrix, np.subtract(a, mouth))
            if t > 0 and 0 <= s <= 1:
                lengths.append(t)
        return np.add(mouth, min(lengths) * direction)

    for k in range(-5, 6):
        end = reach((1.7, 0), np.radians(15 * k))
        axes.plot([1.7, end[0]], [0, end[1]], color=FORCE if k == 0 else SOFT, lw=1.6 if k == 0 else .8,
                  ls="-" if k == 0 else "--")
    end = reach((1.7, 0), 0)
    axes.plot([1.7], [0], "o", color="k", ms=4)
    arrow(axes, (1.2, .35), (1.5, 1.5), "$F_{left}$", at=(.9, 1.75))
    arrow(axes, (1.2, -.35), (1.5, -1.5), "$F_{right}$", at=(.9, -1.8))
    axes.text(5.5, .22, "$L$", ha="center")
    x = 1.7 + .15 * (end[0] - 1.7)
    arrow(axes, (x, 0), (x, -3.2), "$W/2$", "k", (x + .6, -2.4), both=True)
    axes.text(8, -1.1, "15°", color=EDGE)
    axes.text(1.9, .25, "mouth")
    return figure


def arms():
    """A crack beside a free edge: strip, two legs, and the arm as a beam."""
    figure, axes = sketch((5.6, 2.6), (-1.2, 5.4), (-2.4, 1.35))
    shape(axes, [(0, 1), (5.4, 1), (5.4, -2.3), (0, -2.3)], ICE)
    axes.plot([0, 5.2], [0, 0], color=SOFT, ls="--", lw=1)
    axes.text(5.3, -.6, "along the edge it would leave a strip", color=EDGE, ha="right")
    turn = .63 + 1 / np.tan(1.1817)
    axes.plot([0, .63, turn], [0, 0, 1], color=FORCE, lw=2)
    shape(axes, [(0, 0), (.63, 0), (turn, 1), (0, 1)], FORCE, alpha=.18, ec="none")
    axes.text(.48, .6, r"$0.835\,b^2$", ha="center", fontsize=7.5)
    axes.plot([.35], [0], "o", color="k", ms=4)
    axes.text(.3, -.25, "peak: $0.35\\,b$", ha="left")
    arrow(axes, (0, .03), (-.75, .6), "", FORCE)
    arrow(axes, (0, -.03), (-.75, -.6), "", FORCE)
    axes.text(-.95, .75, "$F$", color=FORCE)
    axes.text(-.95, -.85, "$F$", color=FORCE)
    arrow(axes, (2.2, 0), (2.2, 1), "$b$", "k", (2.4, .5), both=True)
    axes.text(4.2, 1.1, "free edge", color=EDGE, ha="center")
    arrow(axes, (0, -1.6), (.63, -1.6), "$0.63\\,b$", "k", (.3, -1.4), both=True)
    arrow(axes, (0, -2), (turn, -2), "$1.04\\,b$", "k", (.55, -1.8), both=True)
    axes.add_patch(Arc((.63, 0), .9, .9, theta1=0, theta2=67.7, color="k"))
    axes.text(1.2, .25, "68°")
    return figure


def tilting():
    """The edge that is pressed down, its resistance, and three hits."""
    figure, (drawing, curve) = plt.subplots(1, 2, figsize=(7.2, 2.8), gridspec_kw={"width_ratios": [1.1, 1]})
    sketch(None, (-3.6, 4.4), (-3, 2.4), drawing)
    shape(drawing, [(-3.6, -3), (4.4, -3), (4.4, 0), (-3.6, 0)], WATER, ec="none")
    turn = np.radians(12)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    box = np.array([(-1.9, .1), (1.9, .1), (1.9, -.8), (-1.9, -.8)])
    drawing.add_patch(Polygon(box + (1.6, .05), closed=True, fc="none", ec=SOFT, ls="--"))
    shape(drawing, box @ rotation.T + (1.6, -.15), ICE)
    shape(drawing, [(-3.6, 2.4), (1.62, 2.4), (-1.28, -2), (-3.6, -2)], HULL, alpha=.85)
    corner = box[0] @ rotation.T + (1.6, -.15)
    arrow(drawing, corner + (0, 1.5), corner, "$V$", "w", corner + (-.3, 1.1))
    arrow(drawing, (.35, .15), (.35, corner[1]), "$w$", "k", (.6, -.1), both=True)
    arrow(drawing, (-3.2, 1.2), (-2.2, 1.2), "$v_n$", "w", (-2.7, 1.5))
    drawing.text(1.7, -.25, "$A,\\ h$", ha="center")
    w = np.linspace(0, 1.2, 200)
    curve.plot(w, np.minimum(2.4 * w, 1), color="k")
    curve.axhline(1, color=SOFT, ls=":", lw=.8)
    curve.axvline(.9, color=FORCE, ls="--", lw=1)
    curve.text(.92, .3, "goes under:\n$w = c_g h$", color=FORCE, va="center")
    curve.text(.05, 1.03, "$V_{rot}$")
    curve.text(.27, .5, "$k\\,w$")
    curve.set(xlabel="deflection of the edge, w / h", ylabel="resistance R / $V_{rot}$", ylim=(0, 1.3), xlim=(0, 1.35))
    figure.tight_layout()
    return figure


def hull_path():
    """Lindqvist's path of a piece under the reference ship, and what it pays."""
    length, beam, draught, stem, entrance, mu = 120, 24, 6, np.radians(30), np.radians(27), .2
    psi = np.arctan(np.tan(stem) / np.sin(entrance))
    rise, bow = draught * (beam + draught) / (beam + 2 * draught), draught / np.tan(stem)
    slide = .7 * length - bow - beam / (4 * np.tan(entrance)) + draught * np.cos(stem) * np.cos(psi) * np.sqrt(
        1 / np.sin(stem)**2 + 1 / np.tan(entrance)**2)
    figure, (drawing, curve) = plt.subplots(2, 1, figsize=(6.4, 3.6), height_ratios=[1.2, 1], sharex=True)
    drawing.fill([-6, 125, 125, -6], [0, 0, -9, -9], color=WATER, lw=0)
    drawing.fill([-6, 0, bow, 118, 125, 125], [3, 0, -draught, -draught, -1, 3], color=HULL, alpha=.85, lw=0)
    s = np.linspace(0, slide, 200)
    drawing.plot(s, -np.minimum(s / bow, 1) * rise, color=FORCE, lw=1.6, ls="--")
    for at in (0, bow, slide * .55, slide):
        drawing.fill(at + np.array([-2, 2, 2, -2]), -min(at / bow, 1) * rise + np.array([.3, .3, -.5, -.5]), color=ICE,
                     ec=EDGE, lw=.8)
    drawing.annotate("", (slide, -8), (0, -8), arrowprops={"arrowstyle": "<|-|>"})
    drawing.text(slide / 2, -7.7, f"$\\bar s$ = {slide:.0f} m", ha="center", va="bottom")
    drawing.annotate("", (-3, -rise), (-3, 0), arrowprops={"arrowstyle": "<|-|>"})
    drawing.text(-4, -rise / 2, f"$\\bar z$ = {rise:.0f} m", ha="right", va="center")
    drawing.set(xlim=(-20, 126), ylim=(-9, 4))
    drawing.axis("off")
    s = np.linspace(-5, slide + 15, 2000)
    pay = np.where((s > 0) & (s < bow), rise / bow, 0) + np.where((s > 0) & (s < slide), mu, 0)
    curve.plot(s, pay, color=FORCE)
    curve.set(xlabel="way of the ship since the piece went under, s [m]", ylabel="force / $w_t$")
    curve.text(bow + 3, .45, "buoyancy, over $s_b$")
    curve.text(slide / 2, mu + .05, "friction, over $\\bar s$")
    figure.tight_layout()
    return figure


def steps():
    """Which bodies are stepped when: the parts of ticks, a floe that wakes, and a frame between two ticks."""
    figure, axes = plt.subplots(figsize=(7.2, 3))
    parts, struck = [1, 4, 1], 1.25
    ends = [tick + part / count for tick, count in enumerate(parts) for part in range(count)] + [len(parts)]
    rows = ["ship", "floe that touches the hull", "floe far away", "floe asleep until struck", "frame"]
    for row, name in enumerate(rows):
        axes.text(-.06, -row, name, ha="right", va="center")
        for begin, end in zip(ends, ends[1:]):
            if name == "frame" or (row == 3 and begin < struck):
                continue
            is_struck = row == 3 and begin == struck
            axes.add_patch(FancyBboxPatch((begin + .012, -row - .25), end - begin - .024, .5, boxstyle="square,pad=0",
                                          fc=FORCE if is_struck else ICE, alpha=.9, ec=EDGE, lw=.7, zorder=2))
    axes.text(.5, -3, "not stepped", color=SOFT, ha="center", va="center", fontsize=8)
    axes.text(struck + .125, -3, "struck", color="w", ha="center", va="center", fontsize=6, zorder=3)
    for end in ends:
        is_tick = end == int(end)
        axes.plot([end, end], [.45, -4.85], color="k" if is_tick else SOFT, lw=1 if is_tick else .7,
                  ls="-" if is_tick else ":", zorder=1)
    for tick, count in enumerate(parts):
        axes.text(tick + .5, .58, f"{count} part{'s' if count > 1 else ''}", ha="center", fontsize=8, color=EDGE)
        arrow(axes, (tick, 1.05), (tick + 1, 1.05), "tick", "k", (tick + .5, 1.26), both=True, fontsize=8)
    asked, written = 1.4, 2
    axes.plot([asked], [-4], "o", color="w", mec=FORCE, ms=6, zorder=3)
    axes.plot([written], [-4], "o", color=FORCE, ms=6, zorder=3)
    arrow(axes, (asked + .04, -4), (written - .035, -4), "", FORCE)
    for time, what in ((asked, "asked for"), (written, "written")):
        axes.text(time, -4.5, what, ha="center", va="center", fontsize=8, color=FORCE, zorder=3,
                  bbox={"fc": "w", "ec": "none", "pad": 1})
    arrow(axes, (0, -5.05), (3.15, -5.05), "time", "k", (3.2, -5.05), ha="left")
    axes.set(xlim=(-1.02, 3.4), ylim=(-5.3, 1.5))
    axes.axis("off")
    return figure


def step():
    """The stages of a step, by what they do."""
    figure, axes = plt.subplots(figsize=(7.2, 2.5))
    groups = [("steer", "pilots, walls"), ("find", "pairs, contacts"), ("decide", "which failure,\nat which force"),
              ("solve", "impulses,\nsplits, tilt"), ("push", "water, wind, engine,\nsubmerged ice"),
              ("move", "integrate"), ("cut", "cusps, splits,\nbrash, under, up"),
              ("record", "ship events,\nloads")]
    for k, (name, what) in enumerate(groups):
        column, row = k % 4, 1 - k // 4
        x, y = column * 2.5, row * 1.5
        axes.add_patch(FancyBboxPatch((x, y), 2, 1, boxstyle="round,pad=.05", fc=FORCE if name == "cut" else ICE,
                                      alpha=.9, ec=EDGE))
        axes.text(x + 1, y + .72, name, ha="center", weight="bold", color="w" if name == "cut" else "k")
        axes.text(x + 1, y + .3, what, ha="center", va="center", fontsize=7.5, color="w" if name == "cut" else "k")
        if column < 3:
            axes.annotate("", (x + 2.42, y + .5), (x + 2.08, y + .5), arrowprops={"arrowstyle": "-|>"})
    axes.annotate("", (1, 1.08), (8.5, 1.42), arrowprops={"arrowstyle": "-|>", "connectionstyle": "arc3,rad=0"})
    axes.set(xlim=(-.2, 9.8), ylim=(-.2, 2.7))
    axes.axis("off")
    return figure


def cut():
    """A local cut: only the boundary in the tool's window is walked exactly."""
    figure, axes = sketch((5.2, 3), (-5.2, 5.9), (-3.3, 3.2))
    angle = np.linspace(0, 2 * np.pi, 41)[:-1]
    radius = 2.6 + .25 * np.sin(5 * angle) + .15 * np.cos(11 * angle)
    ring = np.c_[1.6 * radius * np.cos(angle), radius * np.sin(angle)]
    shape(axes, ring, ICE)
    turn = np.linspace(0, 2 * np.pi, 13)[:-1]
    middle = np.array([4.2, .2])
    tool = middle + np.c_[1.15 * np.cos(turn), 1.15 * np.sin(turn)]
    shape(axes, tool, FORCE, alpha=.25, ec=FORCE)
    low, high = tool.min(axis=0) - .12, tool.max(axis=0) + .12
    axes.add_patch(Polygon([low, (high[0], low[1]), high, (low[0], high[1])], closed=True, fc="none", ec="k", ls="--"))
    inside = ((ring > low) & (ring < high)).all(axis=1)
    axes.plot(*ring[~inside].T, ".", color=SOFT, ms=4)
    axes.plot(*ring[inside].T, "o", color="k", ms=4)
    axes.text(5.6, high[1] + 1.2, "window of the tool:\nhere edges are cut exactly", ha="right")
    axes.text(-.5, -.2, "the far chain is taken over untouched,\nvertex by vertex", ha="center", color=EDGE)
    axes.text(*(middle + (0, -.05)), "tool", color=FORCE, ha="center")
    return figure


FIGURES = {"contact": contact, "wedge": wedge, "radial": radial, "arms": arms, "tilting": tilting,
           "hull-path": hull_path,
           "steps": steps, "step": step, "cut": cut}


def drawn(name):
    """The text of a figure's file."""
    figure, text = FIGURES[name](), io.StringIO()
    figure.savefig(text, format="svg", bbox_inches="tight", pad_inches=.05, metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()


def check():
    found = [name for name in FIGURES if (IMAGES / f"theory-{name}.svg").read_text(encoding="utf-8") != drawn(name)]
    for name in found:
        text = (IMAGES / f"theory-{name}.svg").read_text(encoding="utf-8")
        if f"Matplotlib v{matplotlib.__version__}," not in text:
            print(f"skipped: matplotlib {matplotlib.__version__} did not draw theory-{name}.svg")
            return 77
        print(f"docs/images/theory-{name}.svg is not what tools/theory_figures.py draws: run it")
    return 1 if found else 0


def main(*names):
    if names == ("--check",):
        return check()
    for name in names or FIGURES:
        (IMAGES / f"theory-{name}.svg").write_text(drawn(name), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
