#!/usr/bin/python3
"""A film of a run: a ship on its way through broken ice, as MP4.

    python3 examples/film.py                 (--out FOLDER; --short: the first seconds, as one picture)

Shows how a scene is run into a folder by the program, read back by polynya.Run, and made into a film by polynya.movie;
the command `polynya movie` does the same. Writes film.mp4 (needs ffmpeg: ./setup.sh python) and film.png, a picture of
its middle.
"""
import argparse
import json
import pathlib
import subprocess

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

from polynya.movie import film, picture
from polynya.program import program

SCENE = {
    "name": "a way through broken ice",
    "time": {"step_s": 0.01, "until_s": 240},
    "record": {"forces_interval_s": 0.1, "frames_interval_s": 1},
    "ice": {"thickness_m": 0.4},
    "ships": [{
        "name": "icebreaker",
        "hull": {"length_m": 100, "beam_m": 20, "entrance_angle_deg": 27, "stem_angle_deg": 30,
                 "draught_m": 6, "block_coefficient": 0.58},
        "position_m": [-52, 100], "speed_m_per_s": 4,
        "propulsion": {"engine": {"power_MW": 12, "propeller_diameter_m": 4, "propellers": 2,
                                  "open_water_speed_m_per_s": 8}},
        "steering": {"rudder": {"area_m2": 12}},
        "pilot": {"route": {"waypoints": [{"position_m": [200, 100], "speed_m_per_s": 4},
                                          {"position_m": [500, 300], "speed_m_per_s": 4},
                                          {"position_m": [1000, 300], "speed_m_per_s": 4}]}},
    }],
    "floes": [{"field": {"corner_m": [0, 0], "extent_m": [700, 400], "floe_size_m": 20,
                         "size_spread": 0.25, "concentration": 0.6}}],
}


def run_into(folder, until):
    """The run's folder."""
    scene = {**SCENE, "time": {**SCENE["time"], "until_s": until}}
    path = folder / "film-scene.json"
    path.write_text(json.dumps(scene, indent=1))
    subprocess.run([program(), "run", path, "--out", folder / "film-run", "--overwrite",
                    "--no-map", "--progress", "none"], check=True,
                   stdout=subprocess.DEVNULL)
    return folder / "film-run"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"),
                        help="folder of the run and the film")
    parser.add_argument("--short", action="store_true", help="the first seconds only, and no film")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    run = polynya.Run(run_into(options.out, 10 if options.short else 240), pandas=False)
    look = picture.Look(speed=10, follow="icebreaker")
    times = film.chosen_times(run, speed=10)
    if not options.short:
        film.write(run, str(options.out / "film.mp4"), times, look, lambda done,
                   of: print(f"\rpicture {done} of {of}", end="", flush=True))
        print(f"\n{options.out / 'film.mp4'}")
    middle = times[len(times) // 2:][:1]
    film.write(run, str(options.out / "film.png"), middle,
               picture.Look(is_film=False, follow="icebreaker", start=run.start_time, end=run.end_time))
    print(options.out / "film.png")


if __name__ == "__main__":
    main()
