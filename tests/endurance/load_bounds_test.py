#!/usr/bin/env python3
"""Every check of load_bounds.py and sweep.py can fail: each on a run, or a program, with one planted fault."""

import csv
import json
import math
import os
import pathlib
import stat
import tempfile
import unittest

import load_bounds
import sweep

COLUMNS = ["t_s", "ship"] + [f"{component}{source}{largest}_{'Nm' if component == 'yaw' else 'N'}"
                             for source in ("", "_from_ships") for largest in ("", "_max")
                             for component in load_bounds.COMPONENTS] + ["heading_deg"]
CONTACT_COLUMNS = ["t_s", "ship", "floe_id", "by_ship", "by_floe_id", "fx_N", "fy_N", "width_m", "height_m",
                   "pressure_Pa", "ended_by"]
STRENGTH_N_PER_M = 2e6 * 0.5  # sigma_c h of the floes below

SCENE = {
    "ice": {"thickness_m": 0.5, "compressive_strength_Pa": 2e6, "friction": 0.2}, "contact": {"law": "crush"},
    "ships": [{"name": "barge", "hull": {"waterline_m": [[-20, -5], [20, -5], [20, 5], [-20, 5]],
                                         "angles_from_vertical_deg": [0, 45, 45, 0], "stem_angle_deg": 30}},
              {"name": "wedge", "hull": {"length_m": 60, "beam_m": 12, "entrance_angle_deg": 30,
                                         "stem_angle_deg": 45}}],
    "structures": [{"name": "pile", "radius_m": 1, "wall_angle_deg": 0}],
    "walls": [{"name": "south", "from_m": [0, 0], "to_m": [100, 0], "depth_m": 10}]}
FLOES = [{"floe_id": 0, "parent_id": None, "ring_m": [[0, 0], [80, 0], [80, 80], [0, 80]], "holes_m": []},
         {"floe_id": 1, "parent_id": 0, "ring_parts_m": [[0, 0, 2], [[80, 10], [0, 10]]], "hole_parts_m": []},
         {"floe_id": 2, "parent_id": None, "ring_m": [[0, 0], [0.5, 0], [0.5, 0.5], [0, 0.5]], "holes_m": [],
          "thickness_m": 1, "compressive_strength_Pa": 1e6}]
SUMMARY = {"audit_closed": True, "counts": {"energy_created_J": 0},
           "energy": {"friction_J": 1e3, "crushing_J": 1e4, "restitution_J": -10, "imbalance_J": 0, "turnover_J": 1e6}}


def record(ship, **values):
    return {**dict.fromkeys(COLUMNS, 0), "t_s": 0.1, "ship": ship, **values}


def contact(ship="pile", floe=0, force=0.0, **values):
    """A peak that presses a hull to the west, from the east, on a metre's width and half a metre's height."""
    return {**dict.fromkeys(CONTACT_COLUMNS, ""), "t_s": 0.1, "ship": ship, "by_floe_id": floe,
            "fx_N": -force, "fy_N": 0, "width_m": 1, "height_m": 0.5, "pressure_Pa": force / 0.5, "ended_by": "slip",
            **values}


class Bounds(unittest.TestCase):
    def verdict(self, records=(), contacts=(), scene=None, summary=None):
        """About a run folder with these, and records without loads of all hulls."""
        rows = {name: record(name) for name in ("barge", "wedge", "pile")}
        rows["south"] = record("south", heading_deg=90)  # of a wall, its normal's
        rows.update({row["ship"]: row for row in records or ()})
        with tempfile.TemporaryDirectory() as folder:
            run = pathlib.Path(folder)
            (run / "scene.json").write_text(json.dumps({**SCENE, **(scene or {})}))
            (run / "summary.json").write_text(json.dumps({**SUMMARY, **(summary or {})}))
            (run / "floes.ndjson").write_text("\n".join(json.dumps(floe) for floe in FLOES))
            for name, columns, lines in (("forces.csv", COLUMNS, rows.values() if records is not None else []),
                                         ("contacts.csv", CONTACT_COLUMNS, contacts)):
                with open(run / name, "w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, columns)
                    writer.writeheader()
                    writer.writerows(lines)
            return load_bounds.check_run(run)

    def expect(self, kinds, **run):
        verdict = self.verdict(**run)
        self.assertEqual(verdict.kinds(), kinds, verdict.faults)
        return verdict

    def test_a_run_in_order_has_no_fault_and_was_checked(self):
        verdict = self.expect([], records=[record("barge", surge_N=-5e5, surge_max_N=-1e6)],
                              contacts=[contact(force=1e6), contact(force=1e6, ended_by="")])
        self.assertEqual(verdict.checked, {"records": 4, "means": 24, "steps": 12, "contacts": 1, "peaks": 1,
                                           "floe contacts": 0})
        self.assertEqual(verdict.loaded, {"means": 1, "steps": 1})

    def test_no_record_of_any_hull(self):
        self.expect(["nothing checked"], records=None)

    def test_a_mean_above_the_largest_step_of_every_component(self):
        for source in ("", "_from_ships"):
            for component in load_bounds.COMPONENTS:
                unit = "Nm" if component == "yaw" else "N"
                row = record("wedge", **{f"{component}{source}_{unit}": -1001.0,
                                         f"{component}{source}_max_{unit}": 1000.0})
                self.expect(["mean over step"], records=[row])

    def test_means_and_steps_that_are_equal_but_for_rounding(self):
        self.expect([], records=[record("wedge", surge_N=1000 * (1 + 1e-12), surge_max_N=1000)])

    def test_a_moment_of_rounding_beside_a_great_force(self):
        self.expect([], records=[record("wedge", surge_max_N=1e7, yaw_Nm=2e-4, yaw_max_Nm=1e-5)])
        self.expect(["mean over step"], records=[record("wedge", surge_max_N=1e7, yaw_Nm=1.0, yaw_max_Nm=1e-5)])

    def test_a_step_above_what_all_ice_along_the_hull_bears(self):
        slip = STRENGTH_N_PER_M * 0.2 * math.sqrt(2)  # on walls of 45 degrees
        surge = STRENGTH_N_PER_M * 1.2 * 10 + slip * 2 * 40
        self.expect([], records=[record("barge", surge_max_N=1.01 * surge)])
        self.expect(["step over ice"], records=[record("barge", surge_max_N=-1.03 * surge)])
        self.expect(["step over ice"], records=[record("south", sway_max_N=0.2 * STRENGTH_N_PER_M * 260)])
        self.expect(["step over ice"], records=[record("pile", yaw_max_Nm=1e8)])

    def test_a_peak_above_what_a_pile_is_wide(self):
        self.expect([], contacts=[contact(force=2 * STRENGTH_N_PER_M)])
        self.expect(["peak over ice"], contacts=[contact(force=2.1 * STRENGTH_N_PER_M)])

    def test_a_peak_above_what_the_floe_is_wide(self):
        widest = math.sqrt(0.5)
        self.expect([], contacts=[contact(floe=2, force=widest * STRENGTH_N_PER_M)])
        self.expect(["peak over ice"], contacts=[contact(floe=2, force=1.05 * widest * STRENGTH_N_PER_M)])

    def test_a_hull_is_as_wide_as_it_is_across_the_force_wherever_it_heads(self):
        stem_on = STRENGTH_N_PER_M * 12 * (1 + 0.2 * 1)  # beam, 45 degrees from the vertical at the stem
        self.expect([], contacts=[contact("wedge", force=stem_on)])
        self.expect(["peak over ice"], contacts=[contact("wedge", force=1.04 * stem_on)])
        turned = record("wedge", heading_deg=90)
        self.expect([], records=[turned], contacts=[contact("wedge", force=60 * STRENGTH_N_PER_M)])
        self.expect(["peak over ice"], records=[turned], contacts=[contact("wedge", force=64 * STRENGTH_N_PER_M)])
        self.expect(["peak over ice"], records=[record("wedge", heading_deg=180)],
                    contacts=[contact("wedge", force=stem_on)])

    def test_a_piece_has_the_shape_that_its_parent_leaves_it(self):
        piece = [[0, 0], [80, 0], [80, 10], [0, 10]]
        self.assertAlmostEqual(load_bounds.diameter(piece), math.hypot(80, 10), delta=0.5)
        wall = {"ship": "south", "floe": 1, "fx_N": 0}  # from the north: no more than the piece is wide
        self.expect([], contacts=[contact(force=80 * STRENGTH_N_PER_M, fy_N=-80 * STRENGTH_N_PER_M, **wall)])
        self.expect(["peak over ice"],
                    contacts=[contact(force=83 * STRENGTH_N_PER_M, fy_N=-83 * STRENGTH_N_PER_M, **wall)])

    def test_a_contact_at_a_frame_may_have_what_it_missed(self):
        self.expect([], contacts=[contact(force=3.9 * STRENGTH_N_PER_M, ended_by="")])
        self.expect(["contact over ice"], contacts=[contact(force=4.2 * STRENGTH_N_PER_M, ended_by="")])

    def test_floes_that_press_each_other(self):
        most = math.sqrt(0.5) * 0.5 * 1e6  # the thinner, the weaker
        pair = {"ship": "", "floe_id": 0, "floe": 2, "ended_by": ""}
        self.assertEqual(self.expect([], contacts=[contact(force=most, **pair)]).checked["floe contacts"], 1)
        self.expect(["floe contact over ice"], contacts=[contact(force=2.1 * most, **pair)])

    def test_steel_on_steel_bears_any_load(self):
        steel = self.expect([], contacts=[contact(force=1e12, by_floe_id="", by_ship="barge")])
        self.assertEqual(steel.checked["peaks"], 0)

    def test_rigid_impulses_are_bounded_by_no_ice(self):
        loads = {"records": [record("pile", surge_max_N=1e12)], "contacts": [contact(force=1e12)]}
        self.expect([], scene={"contact": {"law": "impulse"}}, **loads)
        self.expect(["peak over ice", "step over ice"], **loads)

    def test_an_open_audit(self):
        self.expect(["audit"], summary={"audit_closed": False})

    def test_contacts_that_give_energy(self):
        by_step = {"counts": {"energy_created_J": 2e4}}
        self.expect(["energy gained"], summary=by_step)
        self.expect(["energy gained"], summary=by_step, scene={"contact": {"law": "impulse"}})
        altogether = {"energy": {**SUMMARY["energy"], "restitution_J": -2e4}}
        self.expect(["energy gained"], summary=altogether)
        self.expect(["energy gained"], summary=altogether, scene={"contact": {"law": "impulse"}})


SOUND = {"is_sound": True, "invalid": [], "recorded_area": {"wrong": 0}, "balance": {"wrong": 0}, "undecided": 0,
         "overlapping_siblings": 0, "uncrushed_pairs": 0, "unpaid": [], "moments": 3, "shapes": 3,
         "final_places": {"misplaced": [], "fault": None}}


class Verdicts(unittest.TestCase):
    def test_every_reason_of_the_check_is_told(self):
        planted = {"invalid": [1], "recorded_area": {"wrong": 1}, "balance": {"wrong": 1}, "undecided": 1,
                   "overlapping_siblings": 1, "uncrushed_pairs": 1, "unpaid": [1],
                   "final_places": {"misplaced": [], "fault": "a floe is missing"}}
        kinds = [sweep.reasons({**SOUND, key: value})[0][0] for key, value in planted.items()]
        self.assertEqual(len(set(kinds)), len(planted), kinds)
        self.assertEqual(sweep.reasons(SOUND)[0][0], "not sound: unknown")  # of a check that has grown

    def fake(self, folder, **script):
        """A program that does what a line of shell says for each command."""
        program = pathlib.Path(folder) / "program"
        cases = "\n".join(f"{command}) {line};;" for command, line in script.items())
        program.write_text(f"#!/bin/sh\ncase $1 in\n{cases}\nesac\n")
        os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)
        return str(program)

    def kinds(self, timeout_s=10.0, **script):
        with tempfile.TemporaryDirectory() as folder:
            result = {"law": "crush"}
            found = sweep.faults_of(self.fake(folder, **script), pathlib.Path("scene.json"), pathlib.Path(folder),
                                    timeout_s, result)
            return [kind for kind, _ in found]

    def test_every_way_to_end_is_a_kind(self):
        self.assertEqual(self.kinds(validate="exit 3"), ["refused by validate"])
        self.assertEqual(self.kinds(validate="exit 70"), ["validate ends with 70"])
        self.assertEqual(self.kinds(validate="exit 0", run="exit 4"), ["run ends with 4"])
        self.assertEqual(self.kinds(validate="exit 0", run="kill -11 $$"), ["run ends with -11"])
        self.assertEqual(self.kinds(timeout_s=0.3, validate="exit 0", run="exec sleep 5"), ["timeout"])

    def judged(self, check, code):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "check.json").write_text(json.dumps(check))
            program = self.fake(folder, inspect=f"cat {folder}/check.json; exit {code}")
            return [kind for kind, _ in sweep.judge_soundness(program, pathlib.Path(folder), 10.0, {})]

    def test_the_verdict_of_the_check_is_taken_over(self):
        unsound = {**SOUND, "is_sound": False, "unpaid": [1]}
        self.assertEqual(self.judged(SOUND, 0), [])
        self.assertEqual(self.judged(unsound, 4), ["not sound: work of crushing"])
        self.assertEqual(self.judged(unsound, 0), ["the check contradicts its exit code"])
        self.assertEqual(self.judged(SOUND, 5), ["the check ends with exit code 5"])


if __name__ == "__main__":
    unittest.main()
