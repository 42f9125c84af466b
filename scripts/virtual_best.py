#!/usr/bin/env python3
"""How far `auto` is from the virtual best of the other methods, by family and tolerance.

    virtual_best.py RESULTS OUT.md [--solver auto] [--tol 1e-4 1e-6 1e-8] [--floor 1e-4]

RESULTS is a folder of `conebench run` with the common stopping test. The time to a tolerance is
that of the first look at a verified eta at or below it, set-up included; of repetitions the median.
The virtual best is the least of our other methods' times on each problem, known after the fact.
Times below --floor seconds count as that much. A problem that `auto` leaves unsolved in time, and
another method solves, is no time: it is counted apart.
"""
import argparse
import collections
import json
import math
import pathlib
import statistics


def rows_of(folder):
    for path in sorted(pathlib.Path(folder).glob("journal*.jsonl")):
        for line in path.read_text().splitlines():
            row = json.loads(line)
            if row.get("kind") == "method":
                yield row


def time_to(row, tol):
    """Seconds to the first look at eta <= tol, or infinity."""
    return next((time for time, _, eta in row["curve"] or [] if eta is not None and eta <= tol),
                math.inf)


def family(row):
    """The folder above a window's, for files of problem_set.py; else the folder of the file."""
    path = pathlib.Path(row["path"])
    return path.parent.parent.name if path.parent.name.isdigit() else path.parent.name


def times(rows, tol):
    """{(family, problem): {solver: median seconds}}"""
    found = collections.defaultdict(lambda: collections.defaultdict(list))
    for row in rows:
        found[family(row), row["path"]][row["solver"]].append(time_to(row, tol))
    return {key: {solver: statistics.median(values) for solver, values in solvers.items()}
            for key, solvers in found.items()}


def gaps(found, solver, floor):
    """By family: ratios where both solve, names of what only others solve, of what only it does."""
    out = collections.defaultdict(lambda: ([], [], []))
    for (name, problem), seconds in found.items():
        if solver not in seconds:
            continue
        best = min((t for other, t in seconds.items() if other != solver), default=math.inf)
        mine = seconds[solver]
        ratios, missed, alone = out[name]
        if math.isfinite(best) and math.isfinite(mine):
            ratios.append(max(mine, floor) / max(best, floor))
        elif math.isfinite(best):
            missed.append(problem)
        elif math.isfinite(mine):
            alone.append(problem)
    return out


def mean(ratios):
    return math.exp(statistics.fmean(map(math.log, ratios))) if ratios else math.nan


def winners(found, solver):
    """How often each other method is the virtual best."""
    count = collections.Counter()
    for seconds in found.values():
        others = {other: t for other, t in seconds.items() if other != solver}
        best = min(others, key=others.get, default=None)
        if best and math.isfinite(others[best]):
            count[best] += 1
    return ", ".join(f"`{name}` {n}" for name, n in count.most_common())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--solver", default="auto")
    parser.add_argument("--tol", type=float, nargs="+", default=[1e-4, 1e-6, 1e-8])
    parser.add_argument("--floor", type=float, default=1e-4)
    args = parser.parse_args()
    rows = list(rows_of(args.results))
    lines = [f"`scripts/virtual_best.py RESULTS OUT.md --floor {args.floor:g}`", "",
             f"Geometric means of the time of `{args.solver}` over that of the best other method of "
             "ours on each problem, chosen after the fact; times below the floor count as the "
             "floor. *missed*: solved in time by another, not by it; *alone*: by it alone.", ""]
    by_tol = {tol: times(rows, tol) for tol in args.tol}
    families = sorted({name for found in by_tol.values() for name, _ in found})
    lines += ["| family | " + " | ".join(f"{tol:g} | missed, alone" for tol in args.tol) + " |",
              "|---|" + "---:|---|" * len(args.tol)]
    table = {tol: gaps(found, args.solver, args.floor) for tol, found in by_tol.items()}
    for name in families:
        cells = [f"{mean(table[tol][name][0]):.2f} | {len(table[tol][name][1])}, "
                 f"{len(table[tol][name][2])}" for tol in args.tol]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    cells = []
    for tol in args.tol:
        ratios, missed, alone = ([x for part in table[tol].values() for x in part[k]]
                                 for k in range(3))
        cells.append(f"**{mean(ratios):.2f}** ({len(ratios)}), worst {max(ratios, default=0):.1f} | "
                     f"{len(missed)}, {len(alone)}")
    lines += ["| all (problems) | " + " | ".join(cells) + " |", ""]
    for tol, found in by_tol.items():
        lines.append(f"- Best other method at {tol:g}, problems: {winners(found, args.solver)}.")
    for tol in args.tol:
        missed = sorted(pathlib.Path(p).name for part in table[tol].values() for p in part[1])
        if missed:
            lines.append(f"- Missed at {tol:g}: {', '.join(missed)}.")
    args.out.write_text("\n".join(lines) + "\n")
    print(args.out.read_text())


if __name__ == "__main__":
    main()
