"""A picture of a study's report with many small panels: the ice and the ships at the end of some runs."""
from matplotlib.collections import PolyCollection

from ..figures.page import Page, Sheet, plain
from ..results.run import Run
from .folder import RUN
from .measures import rows_by_ship
from .pictures import group_label, save

# Largest number of panels beside each other, and font size of their titles [pt]. More columns make smaller panels, and
# a larger font breaks the titles into more lines.
COLUMNS, SMALL = 4, 6


def choose(study, sample, group_by, count):
    """Selects cases for the picture and returns their numbers: the same number from each group, evenly spaced, and at
    most `count` in total. Only cases whose run folder is kept are selected. `group_by` is the path of a parameter, or
    None for a single group. A group with fewer kept cases than its share gives all of them, and no other group gives
    more instead. If there are more groups than `count`, the last groups have no case. The list may be empty; then there
    is no picture."""
    groups = sample.groups(group_by)
    each, chosen = max(1, count // len(groups)), []
    for _, cases in groups if count > 0 else []:
        numbers = [n for n in sample.columns["case"][cases].astype(int).tolist() if is_kept(study, n)]
        chosen += [numbers[i * len(numbers) // each] for i in range(each)] if len(numbers) > each else numbers
    return chosen[:count]


# Returns True if the case has a run folder with frames, which `keep: summary` and archives do not have.
def is_kept(study, number):
    return (study.case_folder(number) / RUN / "frames.bin").exists()


def draw(study, sample, numbers, group_by, folder):
    """Draws the end of each case of `numbers`, of which there must be at least one, in a panel, and saves the picture
    in `folder` as channels.svg and channels.png, which replace earlier ones. All panels have the same scale and range
    of x and y [m], which contains all ice and tracks, and are at most 60 mm high without their titles. Returns the name
    of the SVG. Raises FolderError if a run is damaged."""
    ends = [read_end(study.case_folder(number) / RUN) for number in numbers]
    columns = min(COLUMNS, len(numbers))
    rows = -(-len(numbers) // columns)
    points = [point for end in ends for ring in end["rings"] for point in ring]
    points += [point for end in ends for ship in end["ships"] for point in ship["track"]]
    (left, right), (low, high) = ((min(axis), max(axis)) for axis in zip(*points))
    row_of = {number: i for i, number in enumerate(sample.columns["case"].astype(int).tolist())}
    with Sheet(Page(), "The ice at the end of some runs", "with the ships and their tracks") as sheet:
        grid = sheet.panels(rows, columns)
        width = sheet.page.width / columns - 4
        lines = 1
        for axes, number, end in zip(grid.flat, numbers, ends):
            draw_end(axes, end)
            axes.set(xlim=(left, right), ylim=(low, high), aspect="equal")
            group = f": {group_label(group_by, sample.columns[group_by][row_of[number]])}" if group_by else ""
            words = sheet.wrapped(plain(f"case {number}{group}"), SMALL, width)
            axes.set_title("\n".join(words), fontsize=SMALL, pad=1.5)
            lines = max(lines, len(words))
        for axes in grid.flat:
            axes.set_axis_off()
        panel = min(60.0, width * (high - low) / (right - left)) + 3 * lines
        return save(sheet.finish(max(10.0, panel) * rows, is_snug=True), folder, "channels")


def read_end(folder):
    """Reads the end of a run: outlines of the floating floes, and for each ship with rows in forces.csv its track over
    the whole run and its waterline, all in the world [m]. The end of an unfinished run is its last frame. Holes of
    floes are left out. Raises FolderError if the folder cannot be read."""
    run = Run(folder, unfinished=True, pandas=False, shapely=False)
    frame, rows = run.frame(run.end_time), rows_by_ship(run.folder / "forces.csv")
    names = [ship["name"] for ship in run.scene["ships"]]
    ships = [{"track": list(zip(rows[name]["x_m"], rows[name]["y_m"])), "hull": frame.hulls[name]}
             for name in names if name in rows]
    floating = [rings for rings, is_under in zip(frame.rings, frame.is_under) if not is_under]
    return {"rings": [rings[0] for rings in floating], "ships": ships}


# Draws what read_end() returns: floes, tracks as lines, and waterlines filled in the colour of the tracks.
def draw_end(axes, end):
    axes.add_collection(PolyCollection(end["rings"], facecolors="#cfe3ef", edgecolors="#5b7f95", linewidths=0.15))
    for ship in end["ships"]:
        axes.plot(*zip(*ship["track"]), color="#d55e00", lw=0.6)
        axes.add_collection(PolyCollection([ship["hull"]], facecolors="#d55e00", edgecolors="none"))
