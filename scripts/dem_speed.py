#!/usr/bin/env python3
"""Milliseconds and bytes of a DEM step, by number of spheres, and where they go.

    dem_speed.py OUT.md [--program conebench] [--only 1000 10000 ...]

Collapse of column-dry with 1e3 to 1e6 spheres, each run warm: every step starts from the reactions
of the last. The medians are over the last half of the steps; a run's memory is its largest resident
set. A row is written as soon as its run has ended.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import tempfile

import common
import scene_runs

# Spheres, steps, tolerance on eta. The steps reach the first impacts, the million only its start.
CASES = ((700, 150, 1e-6), (1000, 120, 1e-3), (10000, 100, 1e-3), (100000, 60, 1e-3),
         (220000, 40, 1e-4), (1000000, 12, 1e-3))
PARTS = ("contact_s", "assembly_s", "solve_s", "engine_s")


def run(program, count, steps, tol, folder):
    """The summary, the rows of the history, and the largest resident set [bytes]."""
    settings = scene_runs.balls(count) | {"solver.tol": tol, "solver.time_limit_s": 100}
    settings["beds[0].width_m"] = settings["columns[0].width_m"]
    command = [str(program), "simulate", "column-dry", "--steps", str(steps), "--json",
               "-o", folder]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    with open(pathlib.Path(folder) / "out.json", "w") as out:
        child = subprocess.Popen(command, stdout=out)
        _, status, usage = os.wait4(child.pid, 0)
    if status:
        raise RuntimeError(f"{' '.join(command)}: status {status}")
    with open(pathlib.Path(folder) / "history.csv") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    summary = json.loads((pathlib.Path(folder) / "out.json").read_text())
    return summary, rows, 1024 * usage.ru_maxrss


def row_of(count, steps, tol, summary, rows, memory):
    late = rows[len(rows) // 2:]
    ms = {part: 1e3 * statistics.median(row[part] for row in late) for part in PARTS}
    total = 1e3 * statistics.median(row["engine_s"] + row["solve_s"] for row in late)
    cones = statistics.median(row["cones"] for row in late)
    rest = ms["engine_s"] - ms["contact_s"] - ms["assembly_s"]
    return {"spheres": summary["bodies"], "contacts": int(cones), "tol": f"{tol:g}",
            "contacts, ms": f"{ms['contact_s']:.2f}", "assembly, ms": f"{ms['assembly_s']:.2f}",
            "solve, ms": f"{ms['solve_s']:.2f}", "rest, ms": f"{rest:.2f}",
            "step, ms": f"{total:.2f}",
            "sweeps or steps": f"{statistics.median(row['iterations'] for row in late):.0f}",
            "above tol": f"{sum(row['converged'] == 0 for row in rows)} of {steps}",
            "MB": f"{memory / 1e6:.0f}",
            "kB a contact": f"{memory / 1e3 / summary['cones_most']:.2f}"}


def exponents(rows):
    """Of the step's time against contacts, from each row to the next of the same tolerance."""
    same = [row for row in rows if row["tol"] == "0.001"]
    return [f"{a['contacts']} to {b['contacts']} contacts: "
            f"{math.log(float(b['step, ms']) / float(a['step, ms'])) / math.log(b['contacts'] / a['contacts']):.2f}"
            for a, b in zip(same, same[1:])]


def page(args, rows):
    head = list(rows[0])
    lines = ["# Speed of the DEM engine", "", f"`scripts/dem_speed.py {args.out.name}`", "",
             f"Machine: {common.machine()}, one core. Medians over the last half of the steps.", "",
             "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(row[key]) for key in head) + " |" for row in rows]
    lines += ["", "Exponent of the step's time at 1e-3: " + "; ".join(exponents(rows)) + "."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--only", type=int, nargs="*", help="these numbers of spheres")
    args = parser.parse_args()
    rows = []
    for count, steps, tol in CASES:
        if args.only and count not in args.only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            rows.append(row_of(count, steps, tol, *run(args.program, count, steps, tol, folder)))
        args.out.write_text(page(args, rows))


if __name__ == "__main__":
    main()
