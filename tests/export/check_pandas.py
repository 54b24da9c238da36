#!/usr/bin/env python3
"""What docs/export.md shows of pandas, done.      exit 77 where pandas is missing"""
import sys

try:
    import pandas
except ImportError:
    print("skipped: python3-pandas is not installed")
    sys.exit(77)

run = sys.argv[1]
forces = pandas.read_csv(f"{run}/forces.csv")
floes = pandas.read_json(f"{run}/floes.ndjson", lines=True)
events = pandas.read_json(f"{run}/events.ndjson", lines=True)
assert forces["t_s"].is_monotonic_increasing and forces["surge_N"].dtype == float
assert (floes["floe_id"] == range(len(floes))).all() and (floes["area_m2"] > 0).all()
assert set(events["kind"]) <= {"bend", "split", "rejected_cut"} and len(events) > 0
broken = events.merge(floes, left_on="floe", right_on="floe_id")
assert len(broken) == len(events)
contacts = pandas.read_csv(f"{run}/contacts.csv")
contacts = contacts[contacts["ended_by"].isna()]  # at frames
pressing = contacts[contacts["t_s"] == contacts["t_s"].max()].merge(floes, left_on="by_floe_id", right_on="floe_id")
assert len(pressing) > 0 and (contacts["depth_m"] > 0).all()
print(f"{len(forces)} rows, {len(floes)} floes, {len(events)} events")
