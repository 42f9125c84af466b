#!/usr/bin/env python3
"""Run-out of a dry column in plane flow against its aspect ratio, beside published scalings.

    run_outs.py OUT [--program conebench] [--work DIR] [--cells 12] [--tol 1e-3]

Column of length L = 0.2 m against a smooth wall, height a L, a = 0.5 to 8, mu = 0.4, rough floor.
The front is where 99 % of the volume lies behind. Writes OUT/run-outs.md and OUT/run-outs.svg; runs
kept in --work are not repeated. Needs matplotlib.
"""
import argparse
import math
import pathlib

import common
import scene_runs

LENGTH = 0.2
RATIOS = (0.5, 1, 1.5, 2, 3, 4, 6, 8)
SCALINGS = (  # (L_end - L) / L of plane collapses, as these papers are usually quoted
    ("Lube et al. 2005 (experiments)", lambda a: 1.2 * a if a < 1.8 else 1.9 * a ** (2 / 3)),
    ("Staron & Hinch 2005 (contact dynamics)",
     lambda a: 2.5 * a if a < 2 else 3.25 * a ** 0.7),
)


def up(value, step):
    return math.ceil(value / step - 1e-9) * step


def run(args, ratio):
    height = ratio * LENGTH
    cell = LENGTH / args.cells
    width = up(LENGTH * (2.5 + 3.6 * ratio ** 0.8), cell)
    tall = up(1.15 * height + 2 * cell, cell)
    fall = math.sqrt(2 * height / 9.81)
    settings = {
        "grid.cells": f"[{round(width / cell)},{round(tall / cell)}]",
        "grid.size_m": f"[{width!r},{tall!r}]", "blocks[0].high_m": f"[{LENGTH},{height}]",
        "step_s": fall / 50, "duration_s": up(4.5 * fall, fall / 50), "solver.tol": args.tol,
        "solver.time_limit_s": 2}
    folder = args.work / f"{args.cells}-{ratio}"
    summary = scene_runs.simulate(args.program, "sand-column", folder, settings)
    places = sorted(x for x, _, _ in scene_runs.last_positions(folder))
    front = places[int(0.99 * len(places))]
    return (front - LENGTH) / LENGTH, scene_runs.history(folder)["fastest_m_s"][-1], summary


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("run-out-runs"))
    parser.add_argument("--cells", type=int, default=12, help="along the column's length")
    parser.add_argument("--tol", type=float, default=1e-3)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    lines = ["# Run-out of dry columns", "",
             f"`scripts/run_outs.py {args.out} --cells {args.cells} --tol {args.tol:g}`", "",
             "Normalised run-out (L_end - L) / L, front at 99 % of the volume, after 4.5 free-fall "
             "times; in brackets our value over the scaling's.", "", "![run-out](run-outs.svg)", "",
             "| a | ours | last speed [m/s] | " + " | ".join(n for n, _ in SCALINGS) + " |",
             "|---|---|---|" + "---|" * len(SCALINGS)]
    found = []
    for ratio in RATIOS:
        run_out, speed, _ = run(args, ratio)
        found.append(run_out)
        cells = [f"{scaling(ratio):.2f} ({run_out / scaling(ratio):.2f})" for _, scaling in SCALINGS]
        lines.append(f"| {ratio} | {run_out:.2f} | {speed:.2g} | " + " | ".join(cells) + " |")
    slope = common.exponent([(a, x) for a, x in zip(RATIOS, found) if a >= 3])
    lines += ["", f"Exponent of our run-out over a >= 3, by least squares: {slope:.2f}. Published for "
              "tall columns: 2/3 (Lube et al. 2005; Lajeunesse et al. 2005), about 0.7 (Staron & "
              "Hinch 2005; Lagrée et al. 2011). Prefactors and exponents are quoted second hand."]
    (args.out / "run-outs.md").write_text("\n".join(lines) + "\n")
    plt = scene_runs.plotting()
    figure, axes = plt.subplots(figsize=(7, 5))
    axes.loglog(RATIOS, found, "ko-", label="conebench, mu = 0.4")
    for (name, scaling), style in zip(SCALINGS, ("C0--", "C1-.")):
        axes.loglog(RATIOS, [scaling(a) for a in RATIOS], style, label=name)
    axes.set(xlabel="aspect ratio a = H / L [-]", ylabel="run-out (L_end - L) / L [-]",
             title="Run-out of dry columns, plane flow")
    axes.legend()
    scene_runs.save(figure, args.out / "run-outs.svg")


if __name__ == "__main__":
    main()
