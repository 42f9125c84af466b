#!/usr/bin/env python3
"""Solves every problem file of a folder with several solvers and judges each answer twice.

    solve_all.py DATA_DIR CHECKER OUT_STEM [-s SOLVER]... [--tol 1e-8] [--time-limit 10s]

CHECKER is a program called as `CHECKER PROBLEM SOLUTION` that prints one JSON line with `eta`,
written independently of this project. It is given each problem in this project's format.
Writes OUT_STEM.csv and OUT_STEM.md. Exit 1 if the two etas differ anywhere by more than
1e-6 eta + 1e-15 + 10 attainable_eta, the rounding of what cancels in u.
"""
import argparse
import csv
import pathlib
import platform
import subprocess
import sys
import tempfile

from common import PROGRAM, machine, run_json, shown

COLUMNS = ["problem", "cones", "solver", "status", "eta", "eta_checker", "attainable_eta",
           "iterations", "setup_s", "solve_s", "agree"]


def problem_files(folder):
    entries = run_json([PROGRAM, "problem", "list", folder, "--json"])
    return [pathlib.Path(entry["path"]) for entry in entries]


def judge(checker, problem, solution):
    interpreter = ["/usr/bin/python3"] if str(checker).endswith(".py") else []
    return run_json([*interpreter, checker, problem, solution])["eta"]


def solve(path, imported, solver, args, scratch):
    answer = scratch / "answer.h5"
    answer.unlink(missing_ok=True)
    row = run_json([PROGRAM, "solve", path, "-s", solver, "--tol", args.tol, "--time-limit",
                    args.time_limit, "--json", "-o", answer])
    eta = row["eta"]
    # An answer of a solver that diverged may not exist.
    checked = judge(args.checker, imported, answer) if answer.exists() else None
    attainable = row.get("attainable_eta", 0.0) or 0.0
    agree = (checked is not None and eta is not None and
             abs(eta - checked) <= 1e-6 * checked + 10 * attainable + 1e-15)
    return {"problem": path.name, "cones": row.get("cones"), "solver": row["solver"],
            "status": row["status"], "eta": eta, "eta_checker": checked,
            "attainable_eta": attainable, "iterations": row["iterations"],
            "setup_s": row.get("setup_s"), "solve_s": row["solve_s"], "agree": agree}


def write_markdown(rows, path, args):
    with open(path, "w") as out:
        out.write("# Every real problem file, each solver once\n\n")
        out.write(f"`scripts/solve_all.py DATA CHECKER OUT {' '.join('-s ' + s for s in args.solver)} "
                  f"--tol {args.tol} --time-limit {args.time_limit}`\n\n")
        out.write(f"Machine: {machine()}, one core a solve, {platform.system()} "
                  f"{platform.machine()}. "
                  "`eta` is this project's residual, `checker` the same by an independent program; "
                  "a residual is not an error bound. Times are solver time: residuals are judged "
                  "with the clock stopped.\n\n")
        solved = {s: sum(r["solver"] == s and r["status"] == "converged" for r in rows)
                  for s in dict.fromkeys(r["solver"] for r in rows)}
        count = len({r["problem"] for r in rows})
        out.write("; ".join(f"{s}: {n} of {count} to {args.tol}" for s, n in solved.items()) + ".\n\n")
        out.write("| problem | cones | solver | status | eta | checker | iterations | solve s |\n")
        out.write("|---|---|---|---|---|---|---|---|\n")
        for r in rows:
            out.write(f"| {r['problem']} | {r['cones']} | {r['solver']} | {r['status']} | "
                      f"{shown(r['eta'])} | {shown(r['eta_checker'])} | {r['iterations']} | "
                      f"{shown(r['solve_s'])} |\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("checker")
    parser.add_argument("out")
    parser.add_argument("-s", "--solver", action="append")
    parser.add_argument("--tol", default="1e-8")
    parser.add_argument("--time-limit", default="10s")
    args = parser.parse_args()
    args.solver = args.solver or ["gs", "spg"]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        for path in problem_files(args.data):
            imported = scratch / "problem.h5"
            imported.unlink(missing_ok=True)
            subprocess.run([PROGRAM, "problem", "export", path, "-o", imported], check=True,
                           stdout=subprocess.DEVNULL)
            for solver in args.solver:
                rows.append(solve(path, imported, solver, args, scratch))
                print(*(shown(rows[-1][c]) for c in COLUMNS), file=sys.stderr)
    with open(args.out + ".csv", "w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    write_markdown(rows, args.out + ".md", args)
    sys.exit(0 if all(row["agree"] for row in rows) else 1)


if __name__ == "__main__":
    main()
