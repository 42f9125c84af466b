#!/usr/bin/env python3
"""`auto` against the fastest solver of Siconos, problem by problem, each stopping by its own test.

    compare_siconos.py DATA_DIR OUT_STEM [--target 1e-6] [--time-limit 20s] [--repetitions 5]

Search    Every Siconos solver runs with tolerances 1e-4, 1e-5, ... 1e-12; the loosest whose answer
          has a verified eta <= target counts, and its time is the solver's. A solver that takes
          three times as long as the fastest so far is given up. Written to OUT_STEM.search.json,
          and read from there when it exists.
Duel      The two fastest of them and `auto` (tolerance: target) run in turns, `repetitions` times
          each; the minimum counts. Ratio: auto over the faster one.
Time      Set-up and solve as recorded: from the problem in memory to r. For Siconos that holds the
          assembly of W where the file has M and H; the ratio to its iterations alone stands beside.

Problems with fewer than 20 cones, or that no solver of Siconos takes, are left out and counted.
Writes OUT_STEM.csv and OUT_STEM.md.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import sys

from common import PROGRAM, machine, run_json, shown

TOLERANCES = [f"1e-{k}" for k in range(4, 13)]
FEWEST_CONES = 20
COLUMNS = ["problem", "cones", "siconos", "tol", "siconos_eta", "siconos_s", "siconos_solve_s",
           "auto_eta", "auto_s", "ratio", "ratio_to_solve"]


def solve(path, solver, tol, limit_s):
    row = run_json([PROGRAM, "solve", path, "-s", solver, "--tol", tol, "--stop", "own",
                    "--time-limit", f"{limit_s:.3f}s", "--json"])
    eta = row["eta"] if row["eta"] is not None else math.inf
    return {"eta": eta, "solve_s": row["solve_s"], "total_s": row["setup_s"] + row["solve_s"],
            "status": row["status"]}


def siconos_solvers():
    return [method["name"] for method in run_json([PROGRAM, "solver", "list", "--json"])
            if method["name"].startswith("siconos:") and method["kind"] == "peer"]


def search(path, target, limit_s):
    """[solver, tolerance, seconds] of each that meets the target, fastest first."""
    found, best_s = [], limit_s
    for solver in siconos_solvers():
        for tol in TOLERANCES:
            run = solve(path, solver, tol, min(limit_s, max(0.05, 3 * best_s)))
            if run["status"] == "unsupported":
                break
            if run["eta"] <= target:
                found.append([solver, tol, run["total_s"]])
                best_s = min(best_s, run["total_s"])
                break
            if run["status"] not in ("converged", "refuted"):
                break
    return sorted(found, key=lambda entry: entry[2])


def duel(path, rivals, target, limit_s, repetitions):
    """The fastest run of each, in turns."""
    contestants = [(solver, tol) for solver, tol, _ in rivals] + [("auto", f"{target:g}")]
    best = {}
    for _ in range(repetitions):
        for solver, tol in contestants:
            run = solve(path, solver, tol, limit_s)
            if run["eta"] <= target and run["total_s"] < best.get(solver, run)["total_s"] * 1.0000001:
                best[solver] = {**run, "tol": tol}
    return best


def geometric_mean(ratios):
    return math.exp(sum(map(math.log, ratios)) / len(ratios))


def bootstrap(ratios, draws=10000):
    rng = random.Random(1)
    means = sorted(geometric_mean(rng.choices(ratios, k=len(ratios))) for _ in range(draws))
    return means[int(0.025 * draws)], means[int(0.975 * draws)]


def summary(rows, key):
    ratios = [row[key] for row in rows if row[key]]
    low, high = bootstrap(ratios)
    wins = sum(ratio < 1 for ratio in ratios)
    return (f"{geometric_mean(ratios):.2f}, 95 % bootstrap interval [{low:.2f}, {high:.2f}], "
            f"auto faster on {wins} of {len(ratios)}")


def write_markdown(rows, left_out, path, args):
    with open(path, "w") as out:
        out.write("# `auto` against the fastest Siconos solver of each problem\n\n")
        out.write(f"`scripts/compare_siconos.py DATA OUT --target {args.target:g} "
                  f"--time-limit {args.time_limit} --repetitions {args.repetitions}`\n\n")
        out.write(f"Machine: {machine()}, one thread. Both sides stop by their own test; every "
                  f"answer is verified at eta <= {args.target:g}. Siconos at the loosest tolerance "
                  "of 1e-4 ... 1e-12 that gives such an answer, the fastest of its solvers chosen for each "
                  "problem after the fact; `auto` chooses by itself. Minimum of interleaved runs.\n\n")
        out.write(f"Geometric mean of the ratios of time, auto / Siconos: {summary(rows, 'ratio')}.\n")
        out.write("With Siconos' set-up (its matrix, where a file gives M and H) free of charge: "
                  f"{summary(rows, 'ratio_to_solve')}.\n")
        alone = [row["problem"] for row in rows if row["auto_s"] and not row["siconos_s"]]
        out.write(f"On {len(alone)} more problems no solver of Siconos gave such an answer in time; "
                  "`auto` did.\n\n")
        out.write("| problem | cones | fastest of Siconos | its tol | its eta | its s | auto eta | "
                  "auto s | ratio | ratio to its solve |\n|---|---|---|---|---|---|---|---|---|---|\n")
        for row in rows:
            out.write("| " + " | ".join(shown(row[key]) for key in (
                "problem", "cones", "siconos", "tol", "siconos_eta", "siconos_s", "auto_eta",
                "auto_s", "ratio", "ratio_to_solve")) + " |\n")
        for name, why in left_out:
            out.write(f"\nLeft out: {name}, {why}.")
        out.write("\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("out")
    parser.add_argument("--target", type=float, default=1e-6)
    parser.add_argument("--time-limit", default="20s")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--search-only", action="store_true")
    args = parser.parse_args()
    limit_s = float(args.time_limit.removesuffix("s"))
    cache_path = pathlib.Path(args.out + ".search.json")
    cache = json.loads(cache_path.read_text()) if cache_path.exists() else {}
    rows, left_out = [], []
    for entry in run_json([PROGRAM, "problem", "list", args.data, "--json"]):
        path = pathlib.Path(entry["path"])
        if entry["cones"] < FEWEST_CONES:
            left_out.append((path.name, f"{entry['cones']} cones"))
            continue
        if path.name not in cache:
            cache[path.name] = search(path, args.target, limit_s)
            cache_path.write_text(json.dumps(cache, indent=1))
            print(path.name, cache[path.name], file=sys.stderr, flush=True)
        if args.search_only:
            continue
        rivals = cache[path.name][:2]
        best = duel(path, rivals, args.target, limit_s, args.repetitions)
        ours = best.pop("auto", None)
        row = dict.fromkeys(COLUMNS, "")
        row.update(problem=path.name, cones=entry["cones"])
        if ours:
            row.update(auto_eta=ours["eta"], auto_s=ours["total_s"])
        if best:
            name, theirs = min(best.items(), key=lambda item: item[1]["total_s"])
            row.update(siconos=name, tol=theirs["tol"], siconos_eta=theirs["eta"],
                       siconos_s=theirs["total_s"], siconos_solve_s=theirs["solve_s"])
        if ours and best:
            row.update(ratio=ours["total_s"] / row["siconos_s"],
                       ratio_to_solve=ours["total_s"] / row["siconos_solve_s"])
        rows.append(row)
        print(*(shown(row[c]) for c in COLUMNS), file=sys.stderr, flush=True)
    if args.search_only:
        return
    with open(args.out + ".csv", "w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    write_markdown(rows, left_out, args.out + ".md", args)


if __name__ == "__main__":
    main()
