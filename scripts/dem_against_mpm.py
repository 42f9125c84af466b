#!/usr/bin/env python3
"""Columns of discs against columns of sand on a grid, dry and cohesive, under three cohesion laws.

    dem_against_mpm.py OUT [--quick] [--program conebench] [--work DIR]

Writes OUT/index.md, OUT/columns.csv (a row a column), and figures: OUT/run-outs.svg, profiles.svg,
fallen.svg, pictures.svg. Runs kept in --work are not repeated, so that what was stopped goes on.
Needs matplotlib. Under 25 min of one core; --quick, two packings and two grids, under 2 min.
"""
import argparse
import itertools
import pathlib

import column_figures
import column_page
import columns_of_discs
import columns_of_sand
import common

# Cohesion over density, gravity and height of the column.
STRENGTHS = (0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.45)
FRICTIONS = (0.3, 0.4, 0.5, 0.6, 0.7)
FULL = {"seeds": (1, 2, 3, 4, 5), "grids": (6, 8, 10), "strengths": STRENGTHS}
QUICK = {"seeds": (1, 2), "grids": (5, 6), "strengths": (0.0, 0.06, 0.2, 0.45)}
COLUMNS = ("of", "seed", "cells", "start", "bond", "strength", "rumpf", "run_out", "fallen",
           "centre", "discs", "bonds_a_disc", "missed", "steps", "seconds")


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def calibrated(args):
    """What is the same for all columns, and what was measured to make it so."""
    dry = [columns_of_discs.run(args, seed, 0.0) for seed in args.seeds]
    tall = mean(r["height_m"] for r in dry)
    run_out = mean(r["run_out"] for r in dry)
    tried = columns_of_sand.dry_run_outs(args, args.grids[1], FRICTIONS, tall)
    friction = columns_of_sand.friction_of(tried, run_out)
    between = [columns_of_sand.friction_of(tried, r["run_out"]) for r in dry]
    pulled = [columns_of_discs.tensile_length(args, seed) for seed in args.seeds]
    hanging = mean(length for length, _ in pulled)
    # Drucker-Prager in the plane: uniaxial tension T = 2 c / (1 + mu).
    length = 0.5 * (1 + friction) * hanging
    return {"tall": tall, "run_out": run_out, "friction": friction, "tried": tried,
            "frictions": (min(between), max(between)),
            "pulled": pulled, "hanging": hanging, "per_bond": length / tall,
            "spread": length * (max(p for p, _ in pulled) - min(p for p, _ in pulled))
            / (2 * hanging * tall)}


def discs(args, known):
    for strength in args.strengths:
        for seed in args.seeds:
            row = columns_of_discs.run(args, seed, strength / known["per_bond"])
            # Rumpf: sigma = Z d F / (4 m g) rho g, c = mu sigma.
            rumpf = (known["friction"] * row["bonds_a_disc"] * columns_of_discs.dem_collapse.DISC
                     * row["bond"] / (4 * known["tall"]))
            yield row | {"of": "discs", "member": f"packing {seed}", "strength": strength,
                         "rumpf": rumpf, "cells": "", "start": ""}


def sand(args, known):
    for law in columns_of_sand.LAWS:
        for strength in args.strengths:
            for cells, start in itertools.product(args.grids, columns_of_sand.STARTS):
                # Without cohesion the laws are one.
                name = law if strength else columns_of_sand.LAWS[0]
                row = columns_of_sand.run(args, cells, start, name, known["friction"],
                                          known["tall"], strength)
                yield row | {"of": law, "member": f"{cells} cells, {start}", "seed": "",
                             "bond": "", "rumpf": "", "discs": "", "bonds_a_disc": ""}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("dem-against-mpm-runs"))
    args = parser.parse_args()
    for name, value in (QUICK if args.quick else FULL).items():
        setattr(args, name, value)
    args.span = 4.5 * columns_of_discs.WIDTH
    args.out.mkdir(parents=True, exist_ok=True)
    known = calibrated(args)
    rows = list(discs(args, known)) + list(sand(args, known))
    common.write_rows(args.out / "columns.csv", COLUMNS,
                      ({name: common.shown(row[name]) for name in COLUMNS} for row in rows))
    column_figures.draw(args, rows)
    (args.out / "index.md").write_text(column_page.page(args, known, rows))


if __name__ == "__main__":
    main()
