#!/usr/bin/env python3
"""The project's own problem set: windows of consecutive steps of both engines' scenes.

    problem_set.py OUT [--full] [--program conebench] [--only FAMILY...] [--pictures]

OUT/<family>/<size>/ gets the problems of one window: --window consecutive steps of one run (warm
starts are in the files), starting where the scene has become what it is named after. OUT has
collection.json (index with features and checksums), families.csv (what differs between families)
and figure.svg; --pictures adds OUT/pictures/<family>.svg, the largest of the small sizes at the end
of its window. Without --full the sizes are up to some 1000 cones, with it up to 1e5. What is there is kept:
a run that was stopped goes on.
"""
import argparse
import csv
import math
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy

import common
import scene_runs
from scene_runs import balls

# Family: scene, first step of the window, and for each size (cones, about) what the scene is
# changed to. Sizes above LARGEST_SMALL are for --full.
LARGEST_SMALL = 3000


def poured(half_side, height, container):
    """Depositions of another region; `container` is the one that holds them, if any."""
    out = {"depositions[0].high_m[2]": f"{height:g}"}
    for what in ["depositions[0]"] + container:
        for axis in (0, 1):
            out[f"{what}.low_m[{axis}]"] = f"{-half_side:g}"
            out[f"{what}.high_m[{axis}]"] = f"{half_side:g}"
    return out


def finer(key, low, high, base, count):
    """The same scene with smaller grains, so that there are `count` for `base`."""
    k = (base / count) ** (1 / 3)
    return {f"{key}[0].radius_range_m": f"[{low * k:.6g},{high * k:.6g}]",
            "skin_m": f"{0.25 * low * k:.3g}", "step_s": f"{1e-3 * math.sqrt(k):.3g}"}


def tower(planks, levels):
    """Planks as long as so many side by side are wide: four contacts for each pair of a level."""
    return {"towers[0].size_m": f"[{0.0235 * planks:g},0.0234,0.0078]",
            "towers[0].planks": planks, "towers[0].levels": levels}


def sand(n, cells):
    return {"grid.cells": "[" + ",".join(str(max(2, round(c * n))) for c in cells) + "]"}


FAMILIES = {
    "spheres-dry": ("column-dry", 60, {10: balls(8), 100: balls(40), 1000: balls(340),
                                       10_000: balls(3400), 100_000: balls(34_000)}),
    "spheres-cohesive": ("column-cohesive", 60, {10: balls(8), 100: balls(40), 1000: balls(340),
                                                 10_000: balls(3400), 100_000: balls(34_000)}),
    "discs-2d": ("collapse-2d", 150, {100: finer("columns", .004, .006, 400, 60), 1000: {},
                                      10_000: finer("columns", .004, .006, 1, 8)}),
    "planks": ("kapla-tower", 5, {10: {"towers[0].levels": 1}, 100: {"towers[0].levels": 3},
                                  1000: {"towers[0].levels": 28},
                                  10_000: tower(9, 31), 100_000: tower(20, 62)}),
    "bricks": ("brick-wall-impact", 15, {
        10: {"walls[0].courses": 2, "walls[0].bricks": 1, "bodies[0].position_m[2]": 0.2},
        100: {"walls[0].courses": 4, "walls[0].bricks": 3, "bodies[0].position_m[2]": 0.3},
        1000: {"walls[0].courses": 14, "walls[0].bricks": 8},
        10_000: {"walls[0].courses": 45, "walls[0].bricks": 25},
        100_000: {"walls[0].courses": 120, "walls[0].bricks": 100}}),
    "masonry": ("masonry-arch", 5, {10: {"arches[0].voussoirs": 5}, 100: {"arches[0].voussoirs": 49},
                                    1000: {"arches[0].voussoirs": 499}}),
    "capsules": ("capsules-deposition", 700, {
        10: poured(0.1, 0.2, ["containers[0]"]), 100: poured(0.15, 0.3, ["containers[0]"]),
        1000: poured(0.25, 0.9, ["containers[0]"]), 10_000: poured(0.6, 2.0, ["containers[0]"])}),
    "mixed-shapes": ("mixed-shapes-heap", 700, {
        10: poured(0.03, 0.1, []), 100: poured(0.055, 0.2, []), 1000: poured(0.1, 0.6, []),
        10_000: poured(0.25, 1.5, [])}),
    "mass-ratio": ("mass-ratio-chain", 20, {10: {"stacks[0].count": 8},
                                            100: {"stacks[0].count": 30, "stacks[0].growth": 1.08}}),
    "hopper": ("hopper", 380, {1000: {}, 10_000: finer("columns", .008, .01, 1, 8)}),
    "drum": ("drum", 500, {1000: {}, 10_000: finer("depositions", .006, .0075, 1, 10)}),
    "avalanche": ("avalanche", 200, {1000: {}}),
    "shaker": ("shaker", 200, {1000: {}}),
    "clump-impact": ("cohesive-clump-impact", 40, {1000: {}}),
    "sand-dry": ("sand-column", 40, {10: sand(0.1, (80, 20)), 100: sand(0.5, (80, 20)),
                                     1000: sand(1.5, (80, 20)), 10_000: sand(5, (80, 20))}),
    "sand-cohesive": ("sand-column-cohesive", 40, {
        10: sand(0.1, (80, 20)), 100: sand(0.5, (80, 20)), 1000: sand(1.5, (80, 20)),
        10_000: sand(5, (80, 20))}),
    "sand-door-3d": ("sand-door", 20, {100: sand(0.5, (24, 4, 12)), 1000: sand(1, (24, 4, 12)),
                                       10_000: sand(2.5, (24, 4, 12))}),
    "sand-silo": ("sand-silo", 40, {1000: {}}),
}


def export_window(args, family, scene, first, size, settings):
    """Exports a window into OUT/family/size unless that has been done."""
    folder = args.out / family / f"{size}"
    if folder.exists():
        return folder
    part = folder.with_name(folder.name + ".part")
    shutil.rmtree(part, ignore_errors=True)
    last = first + args.window - 1
    command = [args.program, "export", scene, "-o", part, "--policy", f"{first}..{last}",
               "--steps", last + 1, "--set", f"name={family}-{size}"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    done = subprocess.run([str(x) for x in command], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit {done.returncode}: "
                           f"{done.stderr.strip()}")
    part.rename(folder)
    return folder


def picture(args, family, scene, first, settings):
    out = args.out / "pictures" / f"{family}.svg"
    if out.exists():
        return
    folder = args.out / "pictures" / family
    scene_runs.simulate(args.program, scene, folder, settings, frames=1, colour="speed",
                        steps=first + args.window)
    out.write_text(scene_runs.last_frame(folder).read_text())
    shutil.rmtree(folder)


def features_of(args, folder):
    """What the program knows of each problem of a window."""
    return [common.run_json([args.program, "problem", "show", path, "--json"])
            for path in sorted(folder.glob("*.h5"))]


ROWS = ("family", "size", "engine", "problems", "cones", "rows_per_dof", "mu", "kappa_share",
        "mobility_ratio", "islands", "eta_stored", "open", "stick", "slide")

# Shares of the largest r', and of mu r'_n: the stored answers are good to about 1e-3.
OPEN, SLIDE = 1e-6, 1 - 1e-3


def states_of(path):
    """Shares of the cones that are open, stick and slide in the answer that the file holds."""
    with h5py.File(path) as file:
        dim, mu = file["problem/dim"][:], file["problem/mu"][:]
        r = file["solution/r"][:]
    least = OPEN * max(abs(r).max(), 1e-300)
    count = {"open": 0, "stick": 0, "slide": 0}
    for part, friction in zip(numpy.split(r, numpy.cumsum(dim)[:-1]), mu):
        tangential = numpy.linalg.norm(part[1:])
        if numpy.linalg.norm(part) <= least:
            count["open"] += 1
        elif tangential >= SLIDE * friction * part[0]:
            count["slide"] += 1
        else:
            count["stick"] += 1
    return {state: number / len(dim) for state, number in count.items()}


def row_of(family, size, facts):
    middle = sorted(facts, key=lambda f: f["cones"])[len(facts) // 2]
    low, high = middle["mobility_min"], middle["mobility_max"]
    return {"family": family, "size": size, "engine": middle["engine"], "problems": len(facts),
            "cones": middle["cones"], "rows_per_dof": middle["rows_per_dof"],
            "mu": middle["mu_max"], "kappa_share": middle["cohesive_share"],
            "mobility_ratio": high / low if low else 0, "islands": middle["islands"],
            "eta_stored": max(f["solution_eta"] for f in facts)} | states_of(middle["path"])


def draw(rows, path):
    """Families side by side in the quantities on which solvers differ."""
    plt = scene_runs.plotting()
    shown = (("cones", "cones", "log"), ("rows_per_dof", "rows per dof: > 1 is hyperstatic", "linear"),
             ("mobility_ratio", "largest / smallest mobility", "log"), ("mu", "friction mu", "linear"),
             ("kappa_share", "share of cohesive cones", "linear"),
             ("islands", "islands", "log"), ("eta_stored", "eta that the engine left", "log"))
    families = list(dict.fromkeys(row["family"] for row in rows))
    figure, axes = plt.subplots(2, 4, figsize=(19, 11), sharey=True)
    for ax, (key, title, scale) in zip(axes.flat, shown):
        for row in rows:
            if row[key] in (None, 0) and scale == "log":
                continue
            dem = row["engine"] == "dem"
            ax.scatter(row[key], families.index(row["family"]), s=36,
                       marker="o" if dem else "s", color="#2c728e" if dem else "#d95f02")
        ax.set_xscale(scale)
        ax.set_title(title, fontsize=11)
        ax.set_yticks(range(len(families)), families)
        ax.grid(alpha=0.3)
    draw_states(axes.flat[-1], rows, families)
    axes[0, 0].invert_yaxis()
    figure.suptitle("The problem set: circles DEM, squares MPM; one mark a size")
    scene_runs.save(figure, path)


def draw_states(ax, rows, families):
    """Of each family's largest problems: shares of open, sticking and sliding cones."""
    left = [0.0] * len(families)
    largest = {row["family"]: row for row in rows}
    for state, colour in (("open", "#bdbdbd"), ("stick", "#2c728e"), ("slide", "#d95f02")):
        shares = [largest[family][state] for family in families]
        ax.barh(range(len(families)), shares, left=left, color=colour, label=state, height=0.7)
        left = [a + b for a, b in zip(left, shares)]
    ax.set_title("states of the cones, largest size", fontsize=11)
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, -0.13), ncol=3, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--full", action="store_true", help="sizes up to 1e5 cones: hours")
    parser.add_argument("--window", type=int, default=5, help="consecutive steps")
    parser.add_argument("--only", nargs="+", choices=FAMILIES, default=list(FAMILIES))
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    args = parser.parse_args()
    rows = []
    for family in args.only:
        scene, first, sizes = FAMILIES[family]
        wanted = {s: v for s, v in sizes.items() if args.full or s <= LARGEST_SMALL}
        for size, settings in wanted.items():
            folder = export_window(args, family, scene, first, size, settings)
            facts = features_of(args, folder)
            if not facts:
                print(f"{family}/{size}: no step of the window has a contact", file=sys.stderr)
                continue
            rows.append(row_of(family, size, facts))
            print(f"{family}/{size}: {len(facts)} problems, {rows[-1]['cones']} cones", flush=True)
        if args.pictures:
            largest = max(s for s in wanted if s <= LARGEST_SMALL)
            picture(args, family, scene, first, wanted[largest])
    subprocess.run([str(args.program), "problem", "index", str(args.out)], check=True)
    with open(args.out / "families.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, ROWS)
        writer.writeheader()
        writer.writerows(rows)
    draw(rows, args.out / "figure.svg")


if __name__ == "__main__":
    main()
