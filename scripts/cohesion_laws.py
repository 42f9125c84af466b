#!/usr/bin/env python3
"""The boundary problem of cohesive sand on a grid: the same columns under every cohesion law.

    cohesion_laws.py OUT [--program conebench] [--work DIR] [--grids 20,40,80] [--tol 1e-3]

Regenerates, for the scene sand-column with a disturbed start (jitter 0.5, one seed for all laws):
  OUT/corner.svg       volume fraction of the nodes at the heap's upper corner (aligned start)
  OUT/states.svg       the heaps after 0.6 s: a row a cohesion, a column a law
                       (dense-only a second time, on a grid refined at the heap's boundary)
  OUT/curves.svg       front, height of the centre of mass and peak speed over time
  OUT/cohesion-laws.md which columns stand on which grid, and from how many starts, refined and
                       not; solves, cycles and energies of the laws
Runs kept in --work are not repeated. Needs matplotlib and h5py.
"""
import argparse
import math
import pathlib
import subprocess

import column_measures
import common
import scene_runs

DENSE = {"material.law": "dense-only"}
HALVES = {"grid.refine": "boundary"}
LAWS = {"uniform": {"material.law": "uniform"}, "dense-only": DENSE,
        "dense-only, refined": DENSE | HALVES,
        "dilation-aware": {"material.law": "dilation-aware"},
        "monotone": {"material.law": "monotone"}}
SHOWN = list(LAWS)[1:]          # without the one that is for the record only
COHESIONS = (0, 80, 400, 4000)  # Pa: strength; the tension cut-off is this over mu = 0.4
STRENGTHS = COHESIONS[1:]       # for the table of what stands
HEIGHT, LENGTH, GRAVITY = 0.8, 1.0, 9.81
SECONDS = 0.6
FULL = 0.999                    # of the largest density: below it a node is not dense
SEEDS = range(1, 7)             # of disturbed starts; 1 is the scene's own
# For the table of starts: what changes on the scene, and how many times finer the grid is.
CASES = {"dense-only": (DENSE, 1), "dense-only, refined": (DENSE | HALVES, 1),
         "dense-only, refined, 4 particles a cell":
             (DENSE | HALVES | {"blocks[0].particles_per_cell": 4}, 1),
         "dense-only, halves everywhere": (DENSE | {"blocks[0].particles_per_cell": 1}, 2),
         "dilation-aware": (LAWS["dilation-aware"], 1), "monotone": (LAWS["monotone"], 1)}


def simulate(args, name, cells, cohesion, changes):
    folder = args.work / name
    settings = {"grid.cells": f"[{cells},{cells // 4}]", "material.cohesion_Pa": cohesion,
                "blocks[0].jitter": 0.5, "duration_s": SECONDS, "solver.tol": args.tol,
                "solver.time_limit_s": 2}
    return scene_runs.simulate(args.program, "sand-column", folder, settings | changes), folder


def run(args, cells, law, cohesion):
    name = f"{cells}-{law.replace(', ', '-')}-{cohesion}"
    return simulate(args, name, cells, cohesion, LAWS[law])


def stands(folder, cells):
    """Nothing moves fast, and the front is within a cell and 5 % of where it was."""
    slow = 0.05 * math.sqrt(GRAVITY * HEIGHT)
    past = scene_runs.history(folder)
    return past["fastest_m_s"][-1] < slow and past["front_m"][-1] < 1.05 * LENGTH + 4 / cells


def verdict(folder, cells):
    past = scene_runs.history(folder)
    return (f"{'stands' if stands(folder, cells) else 'falls'} (front {past['front_m'][-1]:.2f} m, "
            f"peak {past['fastest_m_s'][-1]:.2f} m/s)")


def fallen(folder):
    """Share of the sand that has moved by more than column_measures.FALLEN of the height."""
    before = scene_runs.points_of(folder / "particles_000000.vtp")
    moved = [math.dist(p, q) for p, q in zip(before, scene_runs.last_positions(folder))]
    return sum(m > column_measures.FALLEN * HEIGHT for m in moved) / len(moved)


def underdense_inside(folder, cells):
    """Share of the nodes more than a whole cell inside the heap that are not dense at the start:
    law 6 gives them no cohesion."""
    file = folder / "nodes_000000.vtp"
    depth = 1.001 * 4 / cells
    inside = [phi for (x, y, _), phi in zip(scene_runs.points_of(file),
                                            scene_runs.numbers_of(file, "volume_fraction"))
              if x < LENGTH - depth and y < HEIGHT - depth]
    return sum(phi < FULL for phi in inside) / len(inside)


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
        for law in SHOWN:
            _, folder = run(args, cells, law, cohesion)
            pictures.append((f"{law}, c = {cohesion} Pa", scene_runs.last_frame(folder)))
    scene_runs.side_by_side(pictures, args.out / "states.svg", len(SHOWN))


def draw_curves(args, cells):
    plt = scene_runs.plotting()
    figure, axes = plt.subplots(3, len(COHESIONS), figsize=(4 * len(COHESIONS), 8), sharex=True,
                                sharey="row")
    rows = (("front_m", "front [m]"), ("centre_y_m", "height of centre of mass [m]"),
            ("fastest_m_s", "peak speed [m/s]"))
    styles = dict(zip(LAWS, (":", "-", (0, (5, 1, 1, 1, 1, 1)), "--", "-.")))
    for column, cohesion in enumerate(COHESIONS):
        axes[0, column].set_title(f"c = {cohesion} Pa, cut-off {cohesion / 0.4:.0f} Pa")
        for law in LAWS:
            past = scene_runs.history(run(args, cells, law, cohesion)[1])
            for row, (key, label) in enumerate(rows):
                axes[row, column].plot(past["time_s"], past[key], ls=styles[law], label=law)
                axes[row, 0].set_ylabel(label)
        axes[2, column].set_xlabel("time [s]")
    axes[0, 0].legend()
    scene_runs.save(figure, args.out / "curves.svg")


def table_of_standing(args, grids):
    lines = ["| law | grid | " + " | ".join(f"c = {c} Pa" for c in STRENGTHS) + " |",
             "|---|---|" + "---|" * len(STRENGTHS)]
    for law in SHOWN:
        for cells in grids:
            row = []
            for cohesion in STRENGTHS:
                row.append(verdict(run(args, cells, law, cohesion)[1], cells))
            lines.append(f"| {law} | {cells} x {cells // 4} | " + " | ".join(row) + " |")
    return lines


def from_start(args, case, cells, start, setting):
    changes, finer = CASES[case]
    return simulate(args, f"{cells}-starts-{case.replace(', ', '-')}-{start}", finer * cells,
                    COHESIONS[-1], changes | setting)[1]


def row_of_starts(args, case, cells):
    folders = [from_start(args, case, cells, seed, {"seed": seed}) for seed in SEEDS]
    regular = from_start(args, case, cells, "regular", {"blocks[0].jitter": 0})
    fronts = [scene_runs.history(folder)["front_m"][-1] for folder in folders]
    peaks = [scene_runs.history(folder)["fastest_m_s"][-1] for folder in folders]
    moved = [100 * fallen(folder) for folder in folders]
    inside = [underdense_inside(folder, cells) for folder in folders]
    return (f"| {case} | {cells} x {cells // 4} | "
            f"{sum(stands(folder, cells) for folder in folders)} | "
            f"{min(moved):.0f} to {max(moved):.0f} % | {min(fronts):.2f} to {max(fronts):.2f} | "
            f"{min(peaks):.2f} to {max(peaks):.2f} | "
            f"{100 * sum(inside) / len(inside):.0f} % | {verdict(regular, cells)} |")


def table_of_starts(args, grids):
    lines = [f"| law | grid | of {len(SEEDS)} disturbed starts stand | fallen | fronts [m] | "
             "peak speeds [m/s] | nodes inside below full density at the start | regular start |",
             "|---|---|---|---|---|---|---|---|"]
    return lines + [row_of_starts(args, case, cells) for case in CASES for cells in grids]


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
             "half of their room at the start, the same for all laws; 0.6 s of fall. *refined*: "
             "half-size cells at the heap's boundary only (`grid.refine = \"boundary\"`).", "",
             "![corner](corner.svg)", "", "![states](states.svg)", "", "![curves](curves.svg)", "",
             "## Which columns stand", "",
             "*stands*: after 0.6 s no particle is faster than 0.05 sqrt(g H) and the front is within "
             "5 % and a cell of its start.", ""]
    lines += table_of_standing(args, grids)
    lines += ["", f"## From several starts (c = {COHESIONS[-1]} Pa)", "",
              "The grid is that of whole cells. *halves everywhere*: half-size cells throughout. "
              "The same particles, 2 a whole cell and axis, but for the rows with 4. *fallen*: "
              f"sand that has moved by more than {column_measures.FALLEN:g} H. *regular start*: not "
              "disturbed, in line with the grid.", ""]
    lines += table_of_starts(args, grids)
    lines += ["", f"## The laws at work ({cells} x {cells // 4} cells)", ""]
    lines += table_of_laws(args, cells)
    (args.out / "cohesion-laws.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
