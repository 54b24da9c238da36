"""What is in a co-simulation unit: modelDescription.xml by the rules of FMI 2.0, the library's names, no foreign path.

    unit_test.py POLYNYA SCRATCH SOURCE BUILD
"""
import json
import pathlib
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree as xml
import zipfile

from unpacked import unpack

PROGRAM, SCRATCH, SOURCE, BUILD = sys.argv[1], *map(pathlib.Path, sys.argv[2:5])
SCENE = pathlib.Path(__file__).with_name("coupled.json")

# causality -> variability -> allowed values of `initial`: the combinations of the standard's tables that this unit
# uses.
ALLOWED = {
    ("parameter", "fixed"): {"exact"},
    ("calculatedParameter", "fixed"): {"calculated", "approx"},
    ("input", "continuous"): {None},
    ("input", "discrete"): {None},
    ("output", "continuous"): {"exact", "approx", "calculated"},
    ("output", "discrete"): {"exact", "approx", "calculated"},
}
ORDER = ["CoSimulation", "UnitDefinitions", "TypeDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables",
         "ModelStructure"]
CAPABILITIES = {"canHandleVariableCommunicationStepSize": "true", "canGetAndSetFMUstate": "true",
                "canSerializeFMUstate": "true", "canBeInstantiatedOnlyOncePerProcess": "false",
                "needsExecutionTool": "false", "canInterpolateInputs": "false", "maxOutputDerivativeOrder": "0"}


def schema_node(schema, path):
    """The JSON Schema of a scene's key by its path."""
    node = schema
    for key, index in re.findall(r"([a-z_A-Z0-9]+)(\[\d+\])?", path):
        node = node["properties"][key]
        if index:
            node = node["items"]
        if "oneOf" in node and "properties" not in node:
            node = node["oneOf"][0]
    return node


class Description(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = unpack(PROGRAM, SCENE, SCRATCH / "a unit")
        cls.root = xml.parse(cls.folder / "modelDescription.xml").getroot()
        cls.variables = list(cls.root.find("ModelVariables"))

    def test_the_root_has_what_the_standard_requires_in_its_order(self):
        self.assertEqual(self.root.tag, "fmiModelDescription")
        self.assertEqual(self.root.get("fmiVersion"), "2.0")
        self.assertEqual(self.root.get("modelName"), "coupled")
        self.assertRegex(self.root.get("guid"), r"^\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}$")
        self.assertEqual([child.tag for child in self.root], ORDER)
        capabilities = self.root.find("CoSimulation").attrib
        self.assertEqual(capabilities["modelIdentifier"], "polynya")
        self.assertEqual({name: capabilities[name] for name in CAPABILITIES}, CAPABILITIES)
        experiment = self.root.find("DefaultExperiment").attrib
        self.assertEqual((float(experiment["stopTime"]), float(experiment["stepSize"])), (60, 0.02))

    def test_variables_have_unique_names_and_references_and_allowed_kinds(self):
        names = [v.get("name") for v in self.variables]
        references = [int(v.get("valueReference")) for v in self.variables]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(references, list(range(len(names))))
        for v in self.variables:
            kind = (v.get("causality"), v.get("variability"))
            self.assertIn(kind, ALLOWED, v.get("name"))
            self.assertIn(v.get("initial"), ALLOWED[kind], v.get("name"))
            if kind[1] == "continuous":
                self.assertEqual(v[0].tag, "Real", v.get("name"))

    def test_starts_are_there_where_they_must_be_and_in_range(self):
        for v in self.variables:
            value, name = v[0], v.get("name")
            must = v.get("causality") in ("parameter", "input")
            self.assertEqual("start" in value.attrib, must, name)
            if value.tag == "Boolean":
                if must:
                    self.assertIn(value.get("start"), ("true", "false"))
                continue
            number = float if value.tag == "Real" else int
            low, high = (number(value.get(end)) if value.get(end) else None for end in ("min", "max"))
            if number is int:
                for end in (low, high):
                    self.assertTrue(end is None or abs(end) < 2**31, name)
            if must:
                start = number(value.get("start"))
                self.assertTrue((low is None or low <= start) and (high is None or start <= high), name)

    def test_units_and_types_are_defined(self):
        units = {u.get("name"): u for u in self.root.find("UnitDefinitions")}
        used = {v[0].get("unit") for v in self.variables} - {None}
        self.assertEqual(set(units), used)
        for name, unit in units.items():
            if name == "Pa √m":  # whole exponents cannot state it
                continue
            self.assertEqual([base.tag for base in unit], ["BaseUnit"], name)
            for key, value in unit[0].attrib.items():
                (float if key == "factor" else int)(value)
        types = {t.get("name"): [int(i.get("value")) for i in t.iter("Item")]
                 for t in self.root.find("TypeDefinitions")}
        for v in self.variables:
            if v[0].tag == "Enumeration":
                self.assertIn(int(v[0].get("start")), types[v[0].get("declaredType")])

    def test_the_structure_lists_all_outputs_and_initial_unknowns_in_their_order(self):
        def indices(part):
            return [int(u.get("index")) for u in self.root.find("ModelStructure").find(part)]

        outputs = [i for i, v in enumerate(self.variables, 1) if v.get("causality") == "output"]
        unknown = [i for i, v in enumerate(self.variables, 1)
                   if v.get("causality") == "calculatedParameter" or v.get("causality") == "output"]
        self.assertEqual(indices("Outputs"), outputs)
        self.assertEqual(indices("InitialUnknowns"), unknown)

    def test_parameters_are_keys_of_scenes_with_their_units_and_ranges(self):
        schema = json.loads(subprocess.run([PROGRAM, "schema"], check=True, capture_output=True).stdout)
        checked = set()
        for v in self.variables:
            name, value = v.get("name"), v[0]
            if v.get("causality") != "parameter" or name.endswith(".control") or value.tag == "Boolean":
                continue
            node = schema_node(schema, name)
            for end, excluded in (("minimum", "exclusiveMinimum"), ("maximum", "exclusiveMaximum")):
                given = value.get(end[:3])
                if name.endswith("seed") and end == "maximum":  # the standard's integers are shorter
                    continue
                if end in node:
                    self.assertEqual(float(given), node[end], name)
                elif excluded in node:
                    self.assertTrue(float(given) != node[excluded], name)
                    self.assertAlmostEqual(float(given), node[excluded], delta=1e-9 * max(1, abs(node[excluded])))
                else:
                    self.assertIsNone(given, name)
            if value.get("unit"):
                self.assertIn(f"[{value.get('unit')}]", node.get("description", f"[{value.get('unit')}]"))
            checked.add(name)
        for name in ("seed", "time.step_s", "ice.thickness_m", "ice.flexural_strength_Pa", "water.density_kg_per_m3",
                     "ships[0].speed_m_per_s", "ships[0].propulsion.engine.bollard_pull_kN",
                     "floes[1].field.concentration"):
            self.assertIn(name, checked)

    def test_each_ship_has_its_inputs_and_outputs(self):
        names = {v.get("name") for v in self.variables}
        for ship in ("icebreaker", "barge"):
            for name in ("command.lever", "command.steering_angle_rad", "external.surge_N", "external.yaw_Nm",
                         "motion.x_m", "motion.yaw_rate_rad_per_s", "x_m", "heading_rad", "vx_m_per_s", "ice.surge_N",
                         "ice_friction.surge_N", "submerged_ice.surge_N", "hulls.surge_N", "contacts",
                         "largest_contact_N", "cover_ahead"):
                self.assertIn(f"{ship}.{name}", names)
        self.assertIn("pile.ice.surge_N", names)
        self.assertNotIn("pile.x_m", names)


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = unpack(PROGRAM, SCENE, SCRATCH / "its library")
        cls.binaries = cls.folder / "binaries/linux64"

    def test_it_shows_the_functions_of_the_standard_alone(self):
        header = (SOURCE / "cosim/fmi2.h").read_text()
        functions = set(re.findall(r"FUNCTION\([\w *]+, (fmi2\w+),", header))
        self.assertEqual(len(functions), 34)
        shown = subprocess.run(["nm", "-D", "--defined-only", self.binaries / "polynya.so"], check=True, text=True,
                               capture_output=True).stdout
        self.assertEqual({line.split()[-1] for line in shown.splitlines()}, functions)

    def test_no_path_of_this_machine_is_in_it(self):
        for file in self.folder.rglob("*"):
            if file.is_file():
                for path in (SOURCE, BUILD, pathlib.Path.home()):
                    self.assertNotIn(f"{path}/".encode(), file.read_bytes(), f"{file}: {path}")

    def test_it_loads_with_its_own_libraries_where_polynya_is_not_installed(self):
        code = ("import ctypes, sys; ctypes.CDLL(sys.argv[1]); "
                "print(*{line.split(None, 5)[5].strip() for line in open('/proc/self/maps') if '.so' in line}, "
                "sep='\\n')")
        done = subprocess.run(["/usr/bin/python3", "-I", "-c", code, self.binaries / "polynya.so"], env={}, cwd="/",
                              check=True, text=True, capture_output=True)
        loaded = done.stdout.splitlines()
        for name in ("libgmp.so.10", "libmpfr.so.6"):
            self.assertEqual([path for path in loaded if pathlib.Path(path).name.startswith(name[:7])],
                             [str((self.binaries / name).resolve())])
        for name in ("libtbb", "libfmt", "libstdc++"):
            self.assertFalse([path for path in loaded if pathlib.Path(path).name.startswith(name)], name)

    def test_a_file_that_is_no_library_of_windows_is_not_packed(self):
        out = SCRATCH / "none.fmu"
        for file, words in ((SCENE, "not a library of Windows"), (SCRATCH / "missing.dll", "no such file")):
            done = subprocess.run([PROGRAM, "fmu", SCENE, "--out", out, "--win64", file], text=True, check=False,
                                  capture_output=True)
            self.assertEqual(done.returncode, 5)
            self.assertIn(f"{file}: {words}", done.stderr)
            self.assertFalse(out.exists())

    def test_the_same_scene_gives_the_same_bytes(self):
        first, second = (SCRATCH / name for name in ("one.fmu", "two.fmu"))
        for archive in (first, second):
            subprocess.run([PROGRAM, "fmu", SCENE, "--out", archive], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(first.read_bytes(), second.read_bytes())
        with zipfile.ZipFile(first) as members:
            self.assertEqual(members.namelist(),
                             ["modelDescription.xml", *(f"binaries/linux64/{name}" for name in (
                                 "polynya.so", "libgmp.so.10", "libmpfr.so.6")),
                              "resources/coupled.json", "documentation/licenses.txt"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
