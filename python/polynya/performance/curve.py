"""The runs of a curve: one a thickness, longer until the speed is steady. Finished runs are kept and used again."""
import dataclasses
import json
import pathlib
import subprocess

from .. import formulas
from ..study.case import DONE, STOPPED, summary_of
from . import level_ice

FIRST, MOST = 5, 20  # lengths of the course
VALIDATED_THICKNESS = 0.5  # [m], docs/validation.md, "A ship in level ice"
OUTSIDE = f"thicker than {VALIDATED_THICKNESS:g} m, outside the range of validation"


class RunFailed(Exception):
    pass


class Curve:
    def __init__(self, ship, hull, engine, ice, folder, program, error, step):
        self.ship, self.hull, self.engine, self.ice = ship, hull, engine, ice
        self.folder, self.program, self.error, self.step = pathlib.Path(folder), program, error, step

    def level(self, thickness):
        """The ice of that thickness."""
        return dataclasses.replace(self.ice, thickness=thickness)

    def formula_speeds(self, thickness):
        """The speeds at which published resistances equal the net thrust [m/s]."""
        ice = self.level(thickness)
        pull, fast = self.engine["bollard_pull_N"], self.engine["open_water_speed_m_per_s"]
        resistances = {
            "lindqvist": lambda v: sum(formulas.lindqvist(self.hull, ice, v)),
            "riska": lambda v: formulas.riska(self.hull, ice, v),
            "spencer_jones": lambda v: formulas.spencer_jones(self.hull, ice, v),
        }
        return {name: formulas.equilibrium(pull, fast, of) for name, of in resistances.items()}

    def first_speed(self, thickness):
        """A speed to start at [m/s]: where a bit less than Lindqvist's resistance equals the net thrust."""
        ice = self.level(thickness)
        speed = formulas.equilibrium(
            self.engine["bollard_pull_N"],
            self.engine["open_water_speed_m_per_s"],
            lambda v: 0.8 * sum(formulas.lindqvist(self.hull, ice, v)),
        )
        return max(0.5, speed)

    def run(self, scene, name):
        """The run's folder; of a run that is there already, at once."""
        path, folder = self.folder / (name + ".json"), self.folder / name
        text = json.dumps(scene, indent=1)
        summary = summary_of(folder)
        if summary and summary["finished"] and path.exists() and path.read_text(encoding="utf-8") == text:
            return folder
        path.write_text(text, encoding="utf-8")
        done = subprocess.run(
            [self.program, "run", path, "--out", folder, "--overwrite", "--progress", "none", "--threads", "1"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        if done.returncode == STOPPED:  # Ctrl-C reaches the run too
            raise KeyboardInterrupt
        if done.returncode != DONE:
            raise RunFailed(f"{path}: polynya run ended with {done.returncode}\n{done.stderr.strip()}")
        return folder

    def point(self, thickness):
        """One row of the curve."""
        speed, lengths = self.first_speed(thickness), FIRST
        while True:
            name = f"level-{thickness:g}-{lengths}"
            scene = level_ice.scene(self.ship, self.level(thickness), speed, lengths, self.step)
            way = scene["floes"][0]["rectangle"]["size_m"][0]
            measured = level_ice.Measured(self.run(scene, name), self.ship, way)
            if measured.is_within(self.error) or lengths >= MOST:
                break
            lengths *= 2
        return {
            "thickness_m": thickness,
            "speed_m_per_s": measured.speed,
            "error_m_per_s": measured.error,
            "is_steady": measured.is_within(self.error),
            "is_stuck": bool(measured.is_stuck),
            "is_in_validated_range": thickness <= VALIDATED_THICKNESS,
            "contact_kN": 1e-3 * measured.contact,
            "submerged_kN": 1e-3 * measured.submerged,
            "way_m": measured.way,
            "run": name,
        } | {f"{name}_m_per_s": value for name, value in self.formula_speeds(thickness).items()}
