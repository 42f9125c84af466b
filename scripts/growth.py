#!/usr/bin/env python3
"""Milliseconds and megabytes of a solve against the number of cones, with exponents.

    growth.py SET OUT.md [--program conebench] [--tol 1e-3] [--time-limit 30s] [--reps 3]

SET is a folder of scripts/problem_set.py --full, with the families below; of each size the middle
problem of its window, from its guess. `gs` stands for its sweeps, and so does `gs-parallel` with
two threads: the gain by the second core is the ratio of their milliseconds a sweep.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

import common

FAMILIES = ("spheres-dry", "spheres-cohesive", "sand-dry", "sand-cohesive")
SOLVERS = ("gs", "gs-parallel[threads=1]", "gs-parallel[threads=2]", "auto")
HEAD = ("family", "cones", "solver", "status", "eta", "iterations", "ms", "ms an iteration",
        "us an iteration and cone", "MB", "bytes a cone")


def middle_problems(folder):
    """The middle problem of the window of each size, by size."""
    sizes = sorted((int(p.name), p) for p in folder.iterdir() if p.name.isdigit())
    windows = [sorted(path.glob("*.h5")) for _, path in sizes]
    return [window[len(window) // 2] for window in windows if window]


def measured(args, problem):
    """The journal's rows of one problem, by solver."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([str(args.program), "run", "-p", str(problem), "-s", *SOLVERS, "--mode",
                        "warm", "--tol", str(args.tol), "--time-limit", args.time_limit, "--mem",
                        "16G", "--reps", str(args.reps), "-o", folder],
                       check=True, capture_output=True)
        rows = {}
        for journal in pathlib.Path(folder).glob("*.jsonl"):
            for line in journal.read_text().splitlines():
                row = json.loads(line)
                if "solver" in row:
                    rows.setdefault(row["solver"], []).append(row)
    return rows


def row_of(family, solver, rows):
    seconds = statistics.median(r["setup_s"] + r["solve_s"] for r in rows)
    sweeping = statistics.median(r["solve_s"] / max(r["iterations"], 1) for r in rows)
    cones, memory = rows[0]["cones"], max(r["solver_memory_bytes"] for r in rows)
    return {"family": family, "cones": cones, "solver": solver, "status": rows[0]["status"],
            "eta": f"{rows[0]['eta']:.1e}", "iterations": rows[0]["iterations"],
            "ms": f"{1e3 * seconds:.4g}", "ms an iteration": f"{1e3 * sweeping:.4g}",
            "us an iteration and cone": f"{1e6 * sweeping / cones:.3g}",
            "MB": f"{memory / 1e6:.3g}", "bytes a cone": f"{memory / cones:.0f}"}


def exponents(rows, family, key):
    """Of a column against cones, between neighbouring sizes, for each solver."""
    parts = []
    for solver in SOLVERS:
        size = [(int(r["cones"]), float(r[key])) for r in rows
                if r["family"] == family and r["solver"] == solver]
        powers = [f"{math.log(y / x) / math.log(m / n):.2f}"
                  for (n, x), (m, y) in zip(size, size[1:]) if x > 0 and y > 0]
        parts.append(f"`{solver}` {', '.join(powers)}")
    return "; ".join(parts)


def write_page(args, rows):
    lines = ["# Growth with the number of cones", "",
             f"`scripts/growth.py SET {args.out.name} --tol {args.tol:g} --time-limit "
             f"{args.time_limit} --reps {args.reps}`", "",
             f"Machine: {common.machine()}. Medians; MB is what the solver added to its process at "
             "its largest; a solve ends at eta <= the tolerance or at the time limit, and then its "
             "time says nothing.", "",
             "| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
    lines += ["| " + " | ".join(str(row[key]) for key in HEAD) + " |" for row in rows]
    lines += ["", "Exponents between neighbouring sizes:", ""]
    for family in dict.fromkeys(row["family"] for row in rows):
        for key in ("ms an iteration", "bytes a cone"):
            lines.append(f"- {family}, {key}: {exponents(rows, family, key)}")
    args.out.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("set", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--tol", type=float, default=1e-3)
    parser.add_argument("--time-limit", default="30s")
    parser.add_argument("--reps", type=int, default=3)
    args = parser.parse_args()
    rows = []
    for family in FAMILIES:
        if not (args.set / family).is_dir():
            continue
        for problem in middle_problems(args.set / family):
            found = measured(args, problem)
            rows += [row_of(family, solver, found[solver]) for solver in SOLVERS if solver in found]
            write_page(args, rows)
            print(f"{family}: {rows[-1]['cones']} cones", flush=True)


if __name__ == "__main__":
    main()
