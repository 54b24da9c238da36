#!/usr/bin/env python3
"""Reads an export back with VTK's own reader and compares it with its run.

    /usr/bin/python3 check_vtk.py RUN VTK_FOLDER      exit 77 where VTK's Python module is missing
"""
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
    if event["kind"] != "rejected_cut":
        died[event["floe"]] = event["t_s"]


def read(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / name))
    reader.Update()
    assert reader.GetErrorCode() == 0, name
    return reader.GetOutput()


entries = [e.attrib for e in ElementTree.parse(folder / "run.pvd").iter("DataSet")]
times = sorted({float(e["timestep"]) for e in entries})
assert len(entries) == 3 * len(times) and times, "three files a frame"
worst, vertices = 0.0, 0
for entry in entries:
    time, data = float(entry["timestep"]), read(entry["file"])
    cells = data.GetCellData()
    for i in range(cells.GetNumberOfArrays()):
        assert cells.GetArray(i).GetNumberOfTuples() == data.GetNumberOfCells(), cells.GetArrayName(i)
    if entry["file"].startswith("loads"):
        vertices += data.GetNumberOfVerts()
        assert cells.GetArray("force_N").GetNumberOfComponents() == 3
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
assert vertices > 0
print(f"{len(times)} frames read back with VTK; areas of triangles equal the floes' to {worst:.1e}; {vertices} loads and fractures")
