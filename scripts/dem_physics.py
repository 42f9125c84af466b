#!/usr/bin/env python3
"""What the DEM engine makes of three granular experiments, beside what is known of them.

    dem_physics.py OUT [--program conebench] [--work DIR] [--only run-outs critical drum]

Writes OUT/index.md and, for each experiment, OUT/<experiment>.csv (a row a run, or a search, as it
ends) and OUT/<experiment>.svg; OUT/pictures.svg has one run of each. Runs kept in --work are not
repeated, so that what was stopped goes on. Needs matplotlib. About 15 min of one core.
"""
import argparse
import pathlib

import common
import dem_collapse
import dem_drum
import run_outs
import scene_runs

COLUMNS = {
    "run-outs": ("ratio", "seed", "discs", "aspect_ratio", "run_out", "final_height",
                 "moving_share", "steps_not_converged", "steps"),
    "critical": ("height", "seed", "falls", "stands"),
    "drum": ("friction", "rate_rad_s", "froude", "angle_deg", "spread_deg", "steps_not_converged",
             "steps"),
    "tolerance": ("tol", "run_out", "angle_deg")}
FINE = {"solver.name": "auto", "solver.tol": 1e-3, "solver.max_iterations": 3000}


def unconverged(rows):
    return (f"{sum(r['steps_not_converged'] for r in rows):.0f} of "
            f"{sum(r['steps'] for r in rows):.0f} steps ended at the limit of iterations, at their "
            "best answer.")


def about_run_outs(rows):
    lines = ["## Run-out of dry columns", "", "![run-out](run-outs.svg)", "",
             "Discs of 8 to 12 mm, mu = 0.5, ten wide, against a smooth wall on a floor of glued "
             "discs; a = H / L as the column stands when the gate goes, H twice the height of its "
             "centre of mass. Front: 99 % of the discs are behind. In brackets ours over the "
             "scaling's.", "",
             "| discs | a | run-out | " + " | ".join(n for n, _ in run_outs.SCALINGS) + " |",
             "|---|---|---|" + "---|" * len(run_outs.SCALINGS)]
    for row in rows:
        a, found = row["aspect_ratio"], row["run_out"]
        lines.append(f"| {row['discs']:.0f} | {a:.2f} | {found:.2f} | " + " | ".join(
            f"{scaling(a):.2f} ({found / scaling(a):.2f})" for _, scaling in run_outs.SCALINGS)
            + " |")
    squat, tall, tallest = (
        common.exponent([(r["aspect_ratio"], r["run_out"]) for r in rows
                         if low < r["aspect_ratio"] < high])
        for low, high in ((0, 2), (2, 5), (4.5, 10)))
    return lines + [
        "", f"Exponents by least squares: {squat:.2f} below a = 2, {tall:.2f} from 2 to 5, "
        f"{tallest:.2f} above 4.5. Published: 1 for squat columns, 2/3 for tall ones (Lube et al. "
        "2005; Lajeunesse et al. 2005) to 0.7 (Staron & Hinch 2005); prefactors and "
        "exponents are quoted second hand. Squat columns ten discs wide run out by a few "
        "discs only, less than the scalings, which raises our exponents; those of Staron & Hinch "
        "were larger and rougher. Whether ours reach 2/3 these heights do not show. "
        f"{unconverged(rows)}", ""]


def about_critical(rows):
    share = dem_collapse.per_bond(rows)
    pairs = [(0.5 * (r["falls"] + r["stands"]), r["height"]) for r in rows]
    steep = common.slope(pairs)
    lines = ["## Critical height of cohesive columns", "", "![critical height](critical.svg)", "",
             "Discs poured dry; then contacts get bonds of strength F, a contact point, and 0.1 s "
             "later the gate goes. The column is 3/4 as wide as the loose fill was high. It falls "
             f"when a tenth of the discs has moved by {dem_collapse.FALLEN:g} H within "
             f"{dem_collapse.WATCHED_S:g} s: less is sagging, of columns that then stand. F is "
             "found by "
             f"{dem_collapse.HALVINGS} halvings on one and the same packing, for each of "
             f"{len(dem_collapse.SEEDS)} packings a height. In the plane, since discs are cheap.",
             "", "| H / d | seed | falls at F / (m g) | stands at |", "|---|---|---|---|"]
    lines += [f"| {r['height']:.1f} | {r['seed']:.0f} | {r['falls']:.2f} | {r['stands']:.2f} |"
              for r in rows]
    return lines + [
        "", f"H = {share:.2f} d F / (m g) through 0 by least squares; the slope of a free line is "
        f"{steep:.2f}, its height without bonds {free_height(pairs, steep):.1f} d.", "",
        "Expected: a height proportional to the cohesive length, l = c / (rho g), as the stability "
        "of slopes has it and Gans et al. (J. Fluid Mech. 959, 2023; second hand) find for "
        "columns of coated grains. For a plane of failure through the foot of a wall, "
        "H = 4 l tan(45 deg + phi / 2) (Culmann). With Rumpf's estimate of the strength of a "
        "packing of Z contacts a disc, c = mu sigma and sigma / (rho g) = Z d F / (4 m g), that is "
        "Z mu tan(45 deg + phi / 2) d F / (m g): 2.4 to 3.2 for Z = 3 to 4, phi = arctan(0.5). It "
        "is an upper bound, and lets all bonds break at once.", ""]


def free_height(pairs, steep):
    return (sum(y for _, y in pairs) - steep * sum(x for x, _ in pairs)) / len(pairs)


def about_drum(rows):
    lines = ["## Dynamic angle of repose in a drum", "", "![drum](drum.svg)", "",
             "Spheres of 12 to 15 mm in a drum of 0.2 m, 40 mm long between smooth planes. The "
             "angle is that of the radius to the centre of mass of the fill from the vertical, "
             f"while the drum turns by {dem_drum.MEASURED:g} rad after a first "
             f"{dem_drum.TURNED:g} rad, each at least {dem_drum.SHORTEST_S:g} s; with its standard "
             "deviation in time.",
             "", "| mu | rate [rad/s] | Froude number | angle [degrees] |", "|---|---|---|---|"]
    lines += [f"| {r['friction']:g} | {r['rate_rad_s']:g} | {r['froude']:.4f} | "
              f"{r['angle_deg']:.1f} +- {r['spread_deg']:.1f} |" for r in rows]
    return lines + [
        "", "Expected: 25 to 35 degrees for spheres of mu = 0.5 while the surface is flat, a steep "
        "rise with mu where it is small and hardly any above 0.5, where spheres roll instead of "
        "slide; and larger angles, of a curved surface, where the Froude number is not small. "
        f"{unconverged(rows)}", ""]


def tolerance_rows(args):
    for tol, settings in ((1e-2, {}), (FINE["solver.tol"], FINE)):
        column = dem_collapse.run_out(args, dem_collapse.RATIOS[2], dem_collapse.SEEDS[0], settings)
        drum = dem_drum.run(args, dem_drum.FRICTION, dem_drum.RATE, settings)
        yield {"tol": tol, "run_out": column["run_out"], "angle_deg": drum["angle_deg"]}


def about_tolerance(rows):
    lines = ["## How far the solver's tolerance matters", "",
             f"One column (loose a = {dem_collapse.RATIOS[2]:g}) and one drum (mu = "
             f"{dem_drum.FRICTION:g}, {dem_drum.RATE:g} rad/s) again, solver `auto`:", "",
             "| eta <= | run-out | angle [degrees] |", "|---|---|---|"]
    lines += [f"| {r['tol']:.0e} | {r['run_out']:.2f} | {r['angle_deg']:.1f} |" for r in rows]
    return lines + ["", "The coarse tolerance makes grains a little weaker: for the column by more "
                   "than seeds differ, for the drum by less than its slope varies in time.", ""]


EXPERIMENTS = {"run-outs": (dem_collapse.run_outs_rows, dem_collapse.draw_run_outs, about_run_outs),
               "critical": (dem_collapse.critical_rows, dem_collapse.draw_critical, about_critical),
               "drum": (dem_drum.rows, dem_drum.draw, about_drum),
               "tolerance": (tolerance_rows, None, about_tolerance)}


def draw_pictures(args):
    shown = (("dry column, at rest", f"dry-{dem_collapse.RATIOS[2]}-1"),
             ("drum, mu = 0.5, 1.4 rad/s", f"drum-{dem_drum.FRICTION}-{dem_drum.RATE}"))
    pictures = [(title, scene_runs.last_frame(args.work / folder)) for title, folder in shown]
    for title, folder in dem_collapse.two_sides_of_critical(args):
        pictures.append((title, scene_runs.last_frame(folder)))
    scene_runs.side_by_side(pictures, args.out / "pictures.svg", 2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("dem-physics-runs"))
    parser.add_argument("--only", nargs="+", choices=EXPERIMENTS, default=list(EXPERIMENTS),
                        help="run these; the others' rows are taken as they are")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    lines = ["# Physics of the DEM engine", "",
             f"`scripts/dem_physics.py {args.out}`, solver `gs[omega=1.3]`, eta <= 1e-2 a step, "
             "steps of 1 ms.", "", "![a run of each](pictures.svg)", ""]
    for name, (make, draw, about) in EXPERIMENTS.items():
        table = args.out / f"{name}.csv"
        if name in args.only:
            common.write_rows(table, COLUMNS[name], make(args))
        rows = common.read_rows(table)
        if draw:
            draw(rows, args.out / f"{name}.svg")
        lines += about(rows)
    draw_pictures(args)
    (args.out / "index.md").write_text("\n".join(lines).rstrip() + "\n")


if __name__ == "__main__":
    main()
