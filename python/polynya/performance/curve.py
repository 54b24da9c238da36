"""The runs of a curve: one a thickness, longer until the speed is steady. Finished runs are kept and used again."""
import json
import os
import subprocess

from .. import formulas
from . import level_ice

STOPPED = 75  # polynya's exit code
FIRST, MOST = 5, 20  # lengths of the course


class RunFailed(Exception):
    pass


class Curve:
    def __init__(self, ship, hull, engine, ice, folder, program, error, step):
        self.ship, self.hull, self.engine, self.ice = ship, hull, engine, ice
        self.folder, self.program, self.error, self.step = folder, program, error, step

    def level(self, thickness):
        """The ice of the formulas."""
        given = self.ice
        return formulas.Ice(
            thickness,
            given["flexural_strength_Pa"],
            given["friction"],
            given["density_kg_per_m3"],
            1000.0,
            given["youngs_modulus_Pa"],
            given["poisson_ratio"],
        )

    def formula_speeds(self, thickness):
        """The speeds at which published resistances equal the net thrust [m/s]."""
        ice = self.level(thickness)
        pull, fast = self.engine["bollard_pull"], self.engine["open_water_speed"]
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
            self.engine["bollard_pull"],
            self.engine["open_water_speed"],
            lambda v: 0.8 * sum(formulas.lindqvist(self.hull, ice, v)),
        )
        return max(0.5, speed)

    def run(self, scene, name):
        """The run's folder; of a run that is there already, at once."""
        path, folder = os.path.join(self.folder, name + ".json"), os.path.join(self.folder, name)
        text = json.dumps(scene, indent=1)
        if os.path.exists(os.path.join(folder, "summary.json")) and os.path.exists(path):
            with open(path, encoding="utf-8") as file, open(
                os.path.join(folder, "summary.json"), encoding="utf-8"
            ) as summary:
                if file.read() == text and json.load(summary).get("finished"):
                    return folder
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        done = subprocess.run(
            [self.program, "run", path, "--out", folder, "--overwrite", "--progress", "none", "--threads", "1"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        if done.returncode == STOPPED:  # Ctrl-C reaches the run too
            raise KeyboardInterrupt
        if done.returncode != 0:
            raise RunFailed(f"{path}: polynya run ended with {done.returncode}\n{done.stderr.strip()}")
        return folder

    def point(self, thickness):
        """One row of the curve."""
        speed, lengths, rounds = self.first_speed(thickness), FIRST, 0
        while True:
            name = f"level-{thickness:g}-{lengths}"
            scene = level_ice.scene(self.ship, thickness, speed, lengths, self.ice, self.step)
            way = scene["floes"][0]["rectangle"]["size_m"][0]
            measured = level_ice.Measured(self.run(scene, name), self.ship, way)
            rounds += 1
            if measured.is_within(self.error) or lengths >= MOST:
                break
            lengths *= 2
        return {
            "thickness_m": thickness,
            "speed_m_per_s": measured.speed,
            "error_m_per_s": measured.error,
            "is_steady": measured.is_within(self.error),
            "is_stuck": bool(measured.is_stuck),
            "contact_kN": 1e-3 * measured.contact,
            "submerged_kN": 1e-3 * measured.submerged,
            "way_m": measured.way,
            "run": name,
        } | {f"{name}_m_per_s": value for name, value in self.formula_speeds(thickness).items()}
