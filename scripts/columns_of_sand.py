"""Columns of sand on a grid, set free (for dem_against_mpm.py)."""
import math

import column_measures
import columns_of_discs
import scene_runs

DENSITY = 1500.0
LAWS = ("dense-only", "dilation-aware", "monotone")
STARTS = {"regular": 0.0, "disturbed": 0.5}  # of the particles: share of their room they move in


def run(args, cells, start, law, friction, tall, strength):
    """`cells` along the width; strength: cohesion over density, gravity and height."""
    width = columns_of_discs.WIDTH
    cell = width / cells
    across, up = math.ceil(args.span / cell), math.ceil(1.15 * tall / cell) + 2
    fall = math.sqrt(2 * tall / 9.81)
    settings = {
        "grid.cells": f"[{across},{up}]", "grid.size_m": f"[{across * cell!r},{up * cell!r}]",
        "blocks[0].high_m": f"[{width!r},{tall!r}]", "blocks[0].jitter": STARTS[start],
        "material.friction": f"{friction:.4f}", "material.law": law,
        "material.cohesion_Pa": f"{strength * DENSITY * 9.81 * tall:.6g}",
        "step_s": f"{fall / 30:.6g}", "duration_s": columns_of_discs.SECONDS, "solver.tol": 1e-3,
        "solver.time_limit_s": 2}
    folder = args.work / f"sand-{cells}-{start}-{law}-{friction:.4f}-{strength:.4f}"
    summary = scene_runs.simulate(args.program, "sand-column", folder, settings, colour="speed")
    files = sorted(folder.glob("particles_*.vtp"))
    before, after = ([(x, y) for x, y, _ in scene_runs.points_of(f)]
                     for f in (files[0], files[-1]))
    return column_measures.measured(before, after, width, tall, args.span) | {
        "cells": cells, "start": start, "law": law, "strength": strength, "folder": folder,
        "steps": summary["steps"], "missed": summary["steps_not_converged"],
        "seconds": summary["solve_s"] + summary["transfer_s"] + summary["assembly_s"]}


def dry_run_outs(args, cells, frictions, tall):
    """Mean of both starts, [(friction, run-out)]."""
    tried = []
    for mu in frictions:
        found = [run(args, cells, start, LAWS[0], mu, tall, 0.0)["run_out"] for start in STARTS]
        tried.append((mu, sum(found) / len(found)))
    return tried


def friction_of(tried, wanted):
    """The friction of a run-out, by a straight line between two that were tried."""
    for (mu, far), (more, near) in zip(tried, tried[1:]):
        if near <= wanted <= far:
            return mu + (more - mu) * (far - wanted) / (far - near)
    raise RuntimeError(f"run-outs {tried} do not enclose {wanted:.3f}, expected them to")
