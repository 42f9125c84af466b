#!/usr/bin/env python3
"""The boundary problem of cohesive sand on a grid: the same columns under every cohesion law.

    cohesion_laws.py OUT [--program conebench] [--work DIR] [--grids 20,40,80] [--tol 1e-3]

Regenerates, for the scene sand-column with a disturbed start (jitter 0.5, one seed for all laws):
  OUT/corner.svg       volume fraction of the nodes at the heap's upper corner (aligned start)
  OUT/states.svg       the heaps after 0.6 s: a row a cohesion, a column a law
  OUT/curves.svg       front, height of the centre of mass and peak speed over time
  OUT/cohesion-laws.md which columns stand on which grid; solves, cycles and energies of the laws
Runs kept in --work are not repeated. Needs matplotlib and h5py.
"""
import argparse
import math
import pathlib
import subprocess

import common
import scene_runs

LAWS = ("uniform", "dense-only", "dilation-aware", "monotone")
COHESIONS = (0, 80, 400, 4000)  # Pa: strength; the tension cut-off is this over mu = 0.4
STRENGTHS = COHESIONS[1:]       # for the table of what stands
HEIGHT, LENGTH, GRAVITY = 0.8, 1.0, 9.81
SECONDS = 0.6


def settings(args, cells, law, cohesion, jitter=0.5):
    return {"grid.cells": f"[{cells},{cells // 4}]", "material.law": law,
            "material.cohesion_Pa": cohesion, "blocks[0].jitter": jitter, "duration_s": SECONDS,
            "solver.tol": args.tol, "solver.time_limit_s": 2}


def run(args, cells, law, cohesion):
    folder = args.work / f"{cells}-{law}-{cohesion}"
    summary = scene_runs.simulate(args.program, "sand-column", folder,
                                  settings(args, cells, law, cohesion))
    return summary, folder


def stands(summary, folder, cells):
    """Nothing moves fast, and the front is within a cell and 5 % of where it was."""
    slow = 0.05 * math.sqrt(GRAVITY * HEIGHT)
    past = scene_runs.history(folder)
    return past["fastest_m_s"][-1] < slow and past["front_m"][-1] < 1.05 * LENGTH + 4 / cells


def draw_corner(args):
    import h5py
    plt = scene_runs.plotting()
    folder = args.work / "corner"
    subprocess.run([str(args.program), "export", "sand-column", "-o", str(folder), "--steps", "1",
                    "--set", "solver.tol=1e-2"], check=True, capture_output=True)
    with h5py.File(folder / "sand-column_000000.h5") as file:
        points, fraction = file["geometry/points"][:], file["geometry/volume_fraction"][:]
    figure, axes = plt.subplots(figsize=(6, 4.2))
    near = (points[:, 0] > 0.77) & (points[:, 1] > 0.62)
    drawn = axes.scatter(points[near, 0], points[near, 1], c=fraction[near], s=520, vmin=0, vmax=1,
                         cmap="viridis", edgecolors="#37474f")
    for (x, y, _), phi in zip(points[near], fraction[near]):
        axes.text(x, y, f"{phi:.2f}", ha="center", va="center", fontsize=8,
                  color="white" if phi < 0.6 else "black")
    axes.set(title="Volume fraction of the nodes at the heap's upper corner\n"
                   "(law 6 gives cohesion to the nodes at 1.00 only)",
             xlabel="x [m]", ylabel="y [m]", xlim=(0.76, 1.04), ylim=(0.61, 0.84))
    figure.colorbar(drawn, label="volume fraction [-]")
    scene_runs.save(figure, args.out / "corner.svg")


def draw_states(args, cells):
    pictures = []
    for cohesion in COHESIONS:
        for law in LAWS[1:]:
            _, folder = run(args, cells, law, cohesion)
            pictures.append((f"{law}, c = {cohesion} Pa", scene_runs.last_frame(folder)))
    scene_runs.side_by_side(pictures, args.out / "states.svg", len(LAWS) - 1)


def draw_curves(args, cells):
    plt = scene_runs.plotting()
    figure, axes = plt.subplots(3, len(COHESIONS), figsize=(4 * len(COHESIONS), 8), sharex=True,
                                sharey="row")
    rows = (("front_m", "front [m]"), ("centre_y_m", "height of centre of mass [m]"),
            ("fastest_m_s", "peak speed [m/s]"))
    styles = dict(zip(LAWS, (":", "-", "--", "-.")))
    for column, cohesion in enumerate(COHESIONS):
        axes[0, column].set_title(f"c = {cohesion} Pa, cut-off {cohesion / 0.4:.0f} Pa")
        for law in LAWS:
            past = scene_runs.history(run(args, cells, law, cohesion)[1])
            for row, (key, label) in enumerate(rows):
                axes[row, column].plot(past["time_s"], past[key], styles[law], label=law)
                axes[row, 0].set_ylabel(label)
        axes[2, column].set_xlabel("time [s]")
    axes[0, 0].legend()
    scene_runs.save(figure, args.out / "curves.svg")


def table_of_standing(args, grids):
    lines = ["| law | grid | " + " | ".join(f"c = {c} Pa" for c in STRENGTHS) + " |",
             "|---|---|" + "---|" * len(STRENGTHS)]
    for law in LAWS[1:]:
        for cells in grids:
            row = []
            for cohesion in STRENGTHS:
                summary, folder = run(args, cells, law, cohesion)
                past = scene_runs.history(folder)
                verdict = "stands" if stands(summary, folder, cells) else "falls"
                row.append(f"{verdict} (front {past['front_m'][-1]:.2f} m, "
                           f"peak {past['fastest_m_s'][-1]:.2f} m/s)")
            lines.append(f"| {law} | {cells} x {cells // 4} | " + " | ".join(row) + " |")
    return lines


def table_of_laws(args, cells):
    lines = ["| law | c [Pa] | solves a step | steps that cycled | gave up | not converged | "
             "front [m] | centre height [m] | kinetic + potential energy lost [J] |",
             "|---|---|---|---|---|---|---|---|---|"]
    for cohesion in COHESIONS[1:]:
        for law in LAWS:
            s, folder = run(args, cells, law, cohesion)
            past = scene_runs.history(folder)
            start = 1500 * GRAVITY * LENGTH * HEIGHT * HEIGHT / 2
            lost = start - past["kinetic_J"][-1] - past["potential_J"][-1]
            lines.append(f"| {law} | {cohesion} | {s['solves'] / s['steps']:.2f} | {s['cycles']} of "
                         f"{s['steps']} | {s['capped']} | {s['steps_not_converged']} | "
                         f"{past['front_m'][-1]:.3f} | {past['centre_y_m'][-1]:.3f} | {lost:.0f} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("cohesion-laws-runs"))
    parser.add_argument("--grids", default="20,40,80")
    parser.add_argument("--tol", type=float, default=1e-3)
    args = parser.parse_args()
    grids = [int(x) for x in args.grids.split(",")]
    args.out.mkdir(parents=True, exist_ok=True)
    draw_corner(args)
    cells = 80 if 80 in grids else grids[0]
    draw_states(args, cells)
    draw_curves(args, cells)
    lines = ["# Cohesion laws on a grid", "",
             f"`scripts/cohesion_laws.py {args.out} --grids {args.grids} --tol {args.tol:g}`, "
             f"machine: {common.machine()}, one core.", "",
             "A column 1 m x 0.8 m (mu = 0.4, 1500 kg/m3) on a rough floor, particles disturbed by "
             "half of their room at the start, the same for all laws; 0.6 s of fall.", "",
             "![corner](corner.svg)", "", "![states](states.svg)", "", "![curves](curves.svg)", "",
             "## Which columns stand", "",
             "*stands*: after 0.6 s no particle is faster than 0.05 sqrt(g H) and the front is within "
             "5 % and a cell of its start.", ""]
    lines += table_of_standing(args, grids)
    lines += ["", f"## The laws at work ({cells} x {cells // 4} cells)", ""]
    lines += table_of_laws(args, cells)
    (args.out / "cohesion-laws.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
