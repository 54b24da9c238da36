"""Makes a co-simulation unit by `polynya fmu` and unpacks it, with a list of its variables for the master in C."""
import pathlib
import shutil
import subprocess
import xml.etree.ElementTree as xml
import zipfile

KINDS = {"parameter": "p", "calculatedParameter": "c", "input": "i", "output": "o"}
TYPES = {"Real": "r", "Integer": "i", "Boolean": "b", "Enumeration": "i"}


def unpack(program, scene, folder, *options):
    """The folder with the unit, new each time."""
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    archive = folder.with_suffix(".fmu")
    subprocess.run([program, "fmu", scene, "--out", archive, *options], check=True, stdout=subprocess.DEVNULL)
    with zipfile.ZipFile(archive) as members:
        assert members.testzip() is None
        members.extractall(folder)
    description = xml.parse(folder / "modelDescription.xml").getroot()
    lines = [description.get("guid")]
    for variable in description.iter("ScalarVariable"):
        kind = KINDS[variable.get("causality")]
        lines.append(f"{variable.get('valueReference')} {TYPES[variable[0].tag]} {kind} {variable.get('name')}")
    (folder / "variables.txt").write_text("\n".join(lines) + "\n")
    return folder
