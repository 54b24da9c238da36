"""Writes the tables of `polynya performance`."""
import csv

from ..files import writing


def write_table(path, rows):
    """Writes rows, mappings with the same keys, as CSV, and says where."""
    with writing(path, newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    print(f"table   {path}")
