#!/usr/bin/env python3
"""How many problems each method solves, against the tolerance.

    solved_shares.py DATA_DIR OUT_STEM [-s SOLVER]... [--time-limit 10s] [--jobs 1]

Each solver runs once on each problem of DATA_DIR at tolerance 1e-12; the best eta that it reaches
within the time limit, verified, says which tolerances it meets. A problem that a solver does not
take counts as unsolved and is counted apart. Without -s: every registered solver but the models.
Runs already in OUT_STEM.csv are not repeated. Writes OUT_STEM.csv, OUT_STEM.md and OUT_STEM.svg
(needs matplotlib).
"""
import argparse
import concurrent.futures
import csv
import pathlib
import sys

from common import PROGRAM, machine, run_json

COLUMNS = ["problem", "cones", "solver", "status", "eta", "iterations", "setup_s", "solve_s",
           "notes"]
EXPONENTS = range(2, 13)


def solve(entry, solver, time_limit):
    path = pathlib.Path(entry["path"])
    row = run_json([PROGRAM, "solve", path, "-s", solver, "--tol", "1e-12", "--time-limit",
                    time_limit, "--json"])
    eta = row["eta"] if row["eta"] is not None else "inf"
    return {"problem": path.name, "cones": entry["cones"], "solver": solver,
            "status": row["status"], "eta": eta, "iterations": row["iterations"],
            "setup_s": row["setup_s"], "solve_s": row["solve_s"],
            "notes": "; ".join(row.get("notes", []))}


def registered():
    return [method["name"] for method in run_json([PROGRAM, "solver", "list", "--json"])
            if method["kind"] != "model"]


def counts(rows, solver):
    own = [row for row in rows if row["solver"] == solver]
    taken = sum(row["status"] != "unsupported" for row in own)
    solved = [sum(row["status"] != "unsupported" and float(row["eta"]) <= 10.0 ** -k for row in own)
              for k in EXPONENTS]
    return taken, solved


def write_markdown(rows, solvers, problems, path, args):
    with open(path, "w") as out:
        out.write("# Problems solved, against the tolerance\n\n")
        out.write(f"`scripts/solved_shares.py DATA OUT --time-limit {args.time_limit}"
                  f"{''.join(' -s ' + s for s in args.solver or [])}`\n\n")
        out.write(f"Machine: {machine()}, one thread a solve, {args.jobs} at a time. "
                  f"{problems} distinct problems; a cell says how many of them the method brought "
                  f"to a verified eta of at most the tolerance within {args.time_limit}; `takes` "
                  "how many it accepts. "
                  "Each method runs once, with its default parameters, asked for 1e-12 from the "
                  "start.\n\n![Solved share against tolerance](solved-shares.svg)\n\n")
        out.write("| method | takes | " + " | ".join(f"1e-{k}" for k in EXPONENTS) + " |\n")
        out.write("|---" * (len(EXPONENTS) + 2) + "|\n")
        for solver in solvers:
            taken, solved = counts(rows, solver)
            out.write(f"| {solver} | {taken} | " + " | ".join(map(str, solved)) + " |\n")


def draw(rows, solvers, problems, path):
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams["svg.hashsalt"] = "conebench"
    figure, axes = plt.subplots(figsize=(9, 5.5))
    ours = [s for s in solvers if not s.startswith("siconos:")]
    colours = plt.get_cmap("tab20").colors
    for k, solver in enumerate(solvers):
        solved = counts(rows, solver)[1]
        peer = solver not in ours
        axes.plot([10.0 ** -e for e in EXPONENTS], [100.0 * n / problems for n in solved],
                  "--" if peer else "-", color=colours[k % 20], marker="o", markersize=3,
                  linewidth=3 if solver == "auto" else 1.5, label=solver)
    axes.set_xscale("log")
    axes.invert_xaxis()
    axes.set_xlabel("tolerance on eta [-]")
    axes.set_ylabel(f"solved, % of {problems} problems")
    axes.set_ylim(0, 102)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("out")
    parser.add_argument("-s", "--solver", action="append")
    parser.add_argument("--time-limit", default="10s")
    parser.add_argument("--jobs", type=int, default=1)
    args = parser.parse_args()
    entries = run_json([PROGRAM, "problem", "list", args.data, "--json"])
    solvers = args.solver or registered()
    table = pathlib.Path(args.out + ".csv")
    rows = list(csv.DictReader(open(table))) if table.exists() else []
    done = {(row["problem"], row["solver"]) for row in rows}
    todo = [(entry, solver) for solver in solvers for entry in entries
            if (pathlib.Path(entry["path"]).name, solver) not in done]
    with open(table, "a", newline="") as out, \
            concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        writer = csv.DictWriter(out, COLUMNS)
        if not rows:
            writer.writeheader()
        for row in pool.map(lambda pair: solve(*pair, args.time_limit), todo):
            rows.append(row)
            writer.writerow(row)
            out.flush()
            print(*(row[c] for c in COLUMNS), file=sys.stderr, flush=True)
    write_markdown(rows, solvers, len(entries), args.out + ".md", args)
    draw(rows, solvers, len(entries), args.out + ".svg")


if __name__ == "__main__":
    main()
