#!/usr/bin/env python3
"""Do two solvers that both reach eta <= 1e-10 find the same u? On exported problems of the engine.

    two_solvers.py OUT.md PROBLEM.h5... [--program conebench] [--tol 1e-10] [--limit 20]

Each problem is solved by each of SOLVERS from r = 0; of every pair that reaches --tol the largest
|u_i - u_i'| over the cones, in units of U (the problem's rate scale), is kept. Above 1e-6 a problem
is listed as one of several solutions. The r that the engine stored is evaluated anew as well.
"""
import argparse
import itertools
import pathlib
import tempfile

import h5py
import numpy as np

import common

SOLVERS = ("prox-newton", "aclm", "newton-ac", "gs")
SAME = 1e-6


def solved_rate(args, problem, solver, folder):
    """eta and u of one solve."""
    out = folder / "solution.h5"
    out.unlink(missing_ok=True)
    answer = common.run_json([args.program, "solve", problem, "-s", solver, "--tol", args.tol,
                              "--time-limit", f"{args.limit:g}s", "-o", out, "--json"])
    if answer["eta"] is None or not out.exists():
        return None
    with h5py.File(out) as file:
        return answer["eta"], np.array(file["solution/u"])


def largest_change(u, other, dims):
    starts = np.concatenate(([0], np.cumsum(dims)[:-1]))
    return float(np.sqrt(np.add.reduceat((u - other) ** 2, starts).max()))


def row_of(args, problem, folder):
    facts = common.run_json([args.program, "problem", "show", problem, "--json"])
    stored = common.run_json([args.program, "problem", "verify", problem, "--json"])[0]
    with h5py.File(problem) as file:
        dims = np.array(file["problem/dim"])
    answers = {s: solved_rate(args, problem, s, folder) for s in SOLVERS}
    good = {s: u for s, (eta, u) in ((s, a) for s, a in answers.items() if a) if eta <= args.tol}
    pairs = [largest_change(good[a], good[b], dims) / facts["rate_scale"]
             for a, b in itertools.combinations(good, 2)]
    worst = max(pairs) if pairs else None
    verdict = ("fewer than two solvers reach it" if worst is None else
               "same" if worst <= SAME else "several solutions")
    return [problem.stem, facts["cones"], f"{facts['solution_eta']:.2e}", f"{stored['eta']:.2e}",
            ", ".join(good) or "none", "" if worst is None else f"{worst:.1e}", verdict]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("problems", type=pathlib.Path, nargs="+")
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--tol", type=float, default=1e-10)
    parser.add_argument("--limit", type=float, default=20)
    args = parser.parse_args()
    lines = ["# Two solvers, one u?", "",
             f"`scripts/two_solvers.py OUT.md PROBLEMS --tol {args.tol:g} --limit {args.limit:g}`, "
             "on problems that `conebench export` wrote.", "",
             "| problem | cones | stored eta | evaluated anew | reach the tolerance | "
             "largest change of u / U | |", "|---|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        for problem in args.problems:
            cells = row_of(args, problem, pathlib.Path(folder))
            lines.append("| " + " | ".join(map(str, cells)) + " |")
            args.out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
