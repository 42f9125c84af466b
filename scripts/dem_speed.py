#!/usr/bin/env python3
"""Processor milliseconds and bytes of a DEM step, by number of spheres, and where they go.

    dem_speed.py OUT.md [--program conebench] [--only 1000 10000 ...] [--solver auto]
                 [--iterations 1000000] [--limit 100]
    dem_speed.py OUT.md --export [--pairs 2]

Collapse of column-dry with 1e3 to 1e6 spheres, each run warm: every step starts from the reactions
of the last. The medians are over the last half of the steps; a run's memory is its largest resident
set. Rows are kept in OUT.csv, and a run replaces its own: sizes can be run one by one.

Clocks of the program tell processor time (processor_clock.c), so that a machine with other work
counts little; the page says how much longer than that a run took.

--export: pairs of runs of 1e4 spheres, one without export and one with `--every 10`.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

import common
import scene_runs

# Spheres, steps, tolerance on eta. Up to 1e4 the steps reach the collapse, or its first impacts;
# beyond only the settling of the lowest layers.
CASES = ((343, 120, 1e-6), (1000, 120, 1e-3), (10000, 100, 1e-3), (100000, 60, 1e-3),
         (300000, 40, 1e-4), (1000000, 12, 1e-3))
PARTS = ("contact_s", "assembly_s", "solve_s", "engine_s")
EXPORTED = (10000, 120, 1e-3)


def processor_clock(folder):
    """The library that makes the program's clocks tell processor time."""
    library = pathlib.Path(folder) / "processor_clock.so"
    source = pathlib.Path(__file__).with_name("processor_clock.c")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    return library


def arguments(args, count, tol):
    settings = scene_runs.balls(count) | {"solver.tol": tol, "solver.time_limit_s": args.limit,
                                          "solver.max_iterations": args.iterations}
    settings["beds[0].width_m"] = settings["columns[0].width_m"]
    return [x for key, value in settings.items() for x in ("--set", f"{key}={value}")]


def timed(command, out, preload=None):
    """(wall seconds, processor seconds, largest resident set [bytes]) of a command."""
    environment = os.environ | ({"LD_PRELOAD": str(preload)} if preload else {})
    start = time.monotonic()
    with open(out, "w") as file:
        child = subprocess.Popen(command, stdout=file, env=environment)
        _, status, usage = os.wait4(child.pid, 0)
    if status:
        raise RuntimeError(f"{' '.join(command)}: status {status}")
    wall = time.monotonic() - start
    return wall, usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss


def run(args, count, steps, tol, folder):
    """The summary, the rows of the history, and timed()."""
    command = [str(args.program), "simulate", "column-dry", "-s", args.solver, "--steps",
               str(steps), "--json", "-o", str(folder)] + arguments(args, count, tol)
    used = timed(command, folder / "out.json", processor_clock(folder))
    with open(folder / "history.csv") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    return json.loads((folder / "out.json").read_text()), rows, used


def row_of(args, steps, tol, summary, rows, used):
    late = rows[len(rows) // 2:]
    ms = {part: 1e3 * statistics.median(row[part] for row in late) for part in PARTS}
    total = 1e3 * statistics.median(row["engine_s"] + row["solve_s"] for row in late)
    cones = statistics.median(row["cones"] for row in late)
    rest = ms["engine_s"] - ms["contact_s"] - ms["assembly_s"]
    wall, processor, memory = used
    return {"spheres": summary["bodies"], "contacts": int(cones), "tol": f"{tol:g}",
            "solver": args.solver, "broad phase, ms": f"{ms['contact_s']:.2f}",
            "assembly, ms": f"{ms['assembly_s']:.2f}", "solve, ms": f"{ms['solve_s']:.2f}",
            "rest, ms": f"{rest:.2f}", "step, ms": f"{total:.2f}",
            "iterations": f"{statistics.median(row['iterations'] for row in late):.0f}",
            "above tol": f"{sum(row['converged'] == 0 for row in rows)} of {steps}",
            "MB": f"{memory / 1e6:.0f}",
            "kB a contact": f"{memory / 1e3 / summary['cones_most']:.2f}",
            "wall / processor": f"{wall / processor:.2f}"}


def exponents(rows):
    """Against contacts, between rows of one solver at 1e-3: of the step's time, and of what is not
    the solver's in it."""
    out = []
    for solver in dict.fromkeys(row["solver"] for row in rows):
        size = [(int(row["contacts"]), float(row["step, ms"]),
                 float(row["step, ms"]) - float(row["solve, ms"]))
                for row in rows if row["tol"] == "0.001" and row["solver"] == solver]
        for (n, *small), (m, *large) in zip(size, size[1:]):
            powers = [math.log(y / x) / math.log(m / n) for x, y in zip(small, large)]
            out.append(f"`{solver}`, {n} to {m} contacts: {powers[0]:.2f} and {powers[1]:.2f}")
    return out


def measure_export(args):
    """Rows of pairs of runs, without and with export."""
    count, steps, tol = EXPORTED
    rows = []
    for pair in range(args.pairs):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            common_part = ["column-dry", "-s", args.solver, "--steps", str(steps)]
            without = timed([str(args.program), "simulate"] + common_part +
                            arguments(args, count, tol),
                            folder / "without")
            written = timed([str(args.program), "export"] + common_part +
                            ["--every", "10", "-o", str(folder / "problems")] +
                            arguments(args, count, tol), folder / "with")
            text = (folder / "with").read_text()
            held = re.search(r"held the engine for (\S+) s of (\S+) s", text)
            waits = re.search(r"waited (\d+) times", text)
            megabytes = sum(f.stat().st_size for f in (folder / "problems").iterdir()) / 1e6
        rows.append({"pair": pair + 1, "wall without, s": f"{without[0]:.2f}",
                     "with, s": f"{written[0]:.2f}", "processor without, s": f"{without[1]:.2f}",
                     "processor with, s": f"{written[1]:.2f}",
                     "engine held, s": held[1], "of, s": held[2], "waits": waits[1],
                     "MB written": f"{megabytes:.1f}"})
        print(rows[-1], flush=True)
    return rows


def table(rows):
    head = list(rows[0])
    return (["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] +
            ["| " + " | ".join(str(row[key]) for key in head) + " |" for row in rows])


def share(rows, part, whole):
    return 100 * statistics.median(float(row[part]) / float(row[whole]) for row in rows)


def export_text(rows):
    held = share(rows, "engine held, s", "of, s")
    wall = share(rows, "with, s", "wall without, s") - 100
    processor = share(rows, "processor with, s", "processor without, s") - 100
    count, steps, tol = EXPORTED
    return (["", "## Export", "",
             f"`scripts/dem_speed.py {{out}} --export`: {count} spheres, {steps} steps to {tol:g}, "
             "each pair once without export and once with `--every 10`.", ""] + table(rows) +
            ["", f"Medians: the engine was held for {held:.2g} % of the run; the run took "
             f"{wall:+.1f} % wall and {processor:+.1f} % processor time, the writer's thread "
             "included."])


def read(path):
    if not path.exists():
        return []
    with open(path) as file:
        return list(csv.DictReader(file))


def keep(path, rows):
    common.write_rows(path, list(rows[0]), rows)


def write_page(args):
    rows, exported = read(args.out.with_suffix(".csv")), read(export_file(args.out))
    lines = ["# Speed of the DEM engine", "", f"`scripts/dem_speed.py {args.out.name}`", "",
             f"Machine: {common.machine()}, one core of {os.cpu_count()}. Processor time; medians "
             "over the last half of the steps of a run.", ""]
    if rows:
        lines += table(rows)
        lines += ["", "Exponents at 1e-3, of the step and of all in it but the solver: " +
                  "; ".join(exponents(rows)) + "."]
    if exported:
        lines += [line.replace("{out}", args.out.name) for line in export_text(exported)]
    args.out.write_text("\n".join(lines) + "\n")


def export_file(out):
    return out.with_name(out.stem + "-export.csv")


def same_run(a, b):
    return all(str(a[key]) == str(b[key]) for key in ("spheres", "tol", "solver"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--only", type=int, nargs="*", help="these numbers of spheres")
    parser.add_argument("--solver", default="auto")
    parser.add_argument("--iterations", type=int, default=1000000, help="the most in a step")
    parser.add_argument("--limit", type=float, default=100, help="the most seconds in a step")
    parser.add_argument("--export", action="store_true", help="what export costs, nothing else")
    parser.add_argument("--pairs", type=int, default=2)
    args = parser.parse_args()
    if args.export:
        keep(export_file(args.out), measure_export(args))
    for count, steps, tol in () if args.export else CASES:
        if args.only and count not in args.only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            found = run(args, count, steps, tol, pathlib.Path(folder))
            row = row_of(args, steps, tol, *found)
        kept = [r for r in read(args.out.with_suffix(".csv")) if not same_run(r, row)] + [row]
        kept.sort(key=lambda r: (r["solver"], int(r["spheres"])))
        keep(args.out.with_suffix(".csv"), kept)
        print(row, flush=True)
    write_page(args)


if __name__ == "__main__":
    main()
