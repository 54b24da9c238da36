#!/usr/bin/env python3
"""Reads an export back with VTK's own reader and compares it with its run.

    /usr/bin/python3 check_vtk.py RUN VTK_FOLDER      exit 77 where VTK's Python module is missing
"""
import csv
import json
import math
import pathlib
import sys
from xml.etree import ElementTree

try:
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("skipped: python3-vtk9 is not installed")
    sys.exit(77)

run, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
floes = {}
for line in (run / "floes.ndjson").read_text().splitlines():
    floe = json.loads(line)
    floes[floe["floe_id"]] = floe
died = {}
for line in (run / "events.ndjson").read_text().splitlines():
    event = json.loads(line)
    if event["kind"] in ("bend", "split"):
        died[event["floe"]] = event["t_s"]


def rows_by_time(name):
    rows = {}
    with open(run / name) as file:
        for row in csv.DictReader(file):
            if row.get("ended_by"):  # a peak between frames
                continue
            rows.setdefault(float(row["t_s"]), []).append(row)
    return rows


forces, contacts = rows_by_time("forces.csv"), rows_by_time("contacts.csv")
ships = [ship["name"] for ship in json.loads((run / "scene.json").read_text())["ships"]]


def check_contacts(time, data):
    """Every contact of contacts.csv is there with its numbers; a ship's forces sum to its row of forces.csv."""
    columns, wanted = data.GetPointData(), contacts.get(time, [])
    assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == len(wanted), time
    force = columns.GetArray("force_N")
    assert force.GetNumberOfComponents() == 3
    number = lambda name, i: columns.GetArray(name).GetValue(i)
    for i, row in enumerate(wanted):
        assert data.GetPoint(i) == (float(row["x_m"]), float(row["y_m"]), 0)
        assert force.GetTuple(i) == (float(row["fx_N"]), float(row["fy_N"]), 0)
        assert number("depth_m", i) == float(row["depth_m"]) > 0
        assert number("is_crushing", i) == int(row["is_crushing"])
        assert ships[int(number("ship", i))] == row["ship"] and number("floe_id", i) == -1
        assert number("by_floe_id", i) == int(row["by_floe_id"]) and number("by_ship", i) == -1
    for row in forces.get(time, []):
        of_ship = [i for i in range(len(wanted)) if ships[int(number("ship", i))] == row["ship"]]
        count = int(row["contacts"]) + int(row["contacts_with_ships"])
        assert len(of_ship) == count, (time, len(of_ship), count)
        x, y = (sum(force.GetTuple(i)[axis] for i in of_ship) for axis in (0, 1))
        heading = math.radians(float(row["heading_deg"]))
        surge, sway = x * math.cos(heading) + y * math.sin(heading), y * math.cos(heading) - x * math.sin(heading)
        size = 1 + sum(math.hypot(*force.GetTuple(i)) for i in of_ship)
        for name, found in (("surge", surge), ("sway", sway)):
            wanted_N = float(row[f"{name}_N"]) + float(row[f"{name}_from_ships_N"])
            assert abs(found - wanted_N) < 1e-9 * size, (time, name, found, wanted_N)
    return len(wanted)


def read(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / name))
    reader.Update()
    assert reader.GetErrorCode() == 0, name
    return reader.GetOutput()


entries = [e.attrib for e in ElementTree.parse(folder / "run.pvd").iter("DataSet")]
times = sorted({float(e["timestep"]) for e in entries})
assert len(entries) == 4 * len(times) and times, "four files a frame"
worst, vertices, touching = 0.0, 0, 0
for entry in entries:
    time, data = float(entry["timestep"]), read(entry["file"])
    cells = data.GetCellData()
    for i in range(cells.GetNumberOfArrays()):
        assert cells.GetArray(i).GetNumberOfTuples() == data.GetNumberOfCells(), cells.GetArrayName(i)
    if entry["file"].startswith("loads"):
        vertices += data.GetNumberOfVerts()
        assert cells.GetArray("force_N").GetNumberOfComponents() == 3
    if entry["file"].startswith("contacts"):
        touching += check_contacts(time, data)
    if not entry["file"].startswith("ice"):
        continue
    alive = {i for i, f in floes.items() if f["born_s"] <= time < died.get(i, math.inf)}
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(data)
    sizes.Update()
    area = sizes.GetOutput().GetCellData().GetArray("Area")
    sums, masses = {}, {}
    for i in range(data.GetNumberOfCells()):
        floe = int(cells.GetArray("floe_id").GetValue(i))
        sums[floe] = sums.get(floe, 0.0) + (0 if cells.GetArray("is_outline").GetValue(i) else area.GetValue(i))
        mass = cells.GetArray("mass_kg").GetValue(i)
        assert mass == floes[floe]["mass_kg"], (entry["file"], i, floe, mass, floes[floe]["mass_kg"])
        assert cells.GetArray("generation").GetValue(i) == floes[floe]["generation"]
    assert set(sums) == alive, f"{entry['file']}: {len(sums)} floes, the run has {len(alive)}"
    for floe, total in sums.items():
        worst = max(worst, abs(total - floes[floe]["area_m2"]) / floes[floe]["area_m2"])
assert worst < 1e-6, worst
assert vertices > 0 and touching > 10 and touching == sum(map(len, contacts.values()))
print(f"{len(times)} frames read back with VTK; areas of triangles equal the floes' to {worst:.1e}; "
      f"{vertices} loads and fractures; {touching} contacts, whose forces sum to the ship's loads")
