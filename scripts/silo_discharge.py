#!/usr/bin/env python3
"""How fast a silo of sand empties, by the height of the filling and the width of the outlet.

    silo_discharge.py OUT [--program conebench] [--work DIR] [--tol 1e-3]

The scene sand-silo, its outlet and its filling changed, dry sand of mu = 0.4 and, for comparison, a
liquid of mu = 0 between smooth walls. Rates are slopes, by least squares, of the sand that is left
above the shelf against time. Writes OUT/silo-discharge.md and OUT/silo-discharge.svg; runs kept in
--work are not repeated. Needs matplotlib.
"""
import argparse
import bisect
import math
import pathlib
import xml.etree.ElementTree

import common
import scene_runs

WIDTH, SHELF, MIDDLE = 0.8, 0.2, 0.4  # of the scene [m]
HEIGHTS = (0.6, 0.8, 1.0, 1.2)
OUTLETS = (0.15, 0.2, 0.25, 0.3)
USUAL, FILLED = 0.2, 1.0              # of the runs that differ in the other [m]
STARTED = 0.3                         # s: the flow is steady by then
LIQUID = {"material.friction": 0, "walls.left": '"slip"', "walls.right": '"slip"'}


class Discharge:
    """One run: the area of densest sand above the shelf [m2] over time."""

    def __init__(self, args, height, outlet, liquid=False):
        settings = {"blocks[0].high_m": f"[{WIDTH},{SHELF + height:g}]",
                    "barriers[0].high_m": f"[{MIDDLE - outlet / 2:g},{SHELF}]",
                    "barriers[1].low_m": f"[{MIDDLE + outlet / 2:g},{SHELF}]",
                    "duration_s": 1.6, "solver.tol": args.tol}
        self.height, self.outlet, self.liquid = height, outlet, liquid
        self.folder = args.work / f"{height:g}-{outlet:g}{'-liquid' if liquid else ''}"
        scene_runs.simulate(args.program, "sand-silo", self.folder,
                            settings | (LIQUID if liquid else {}), frames=4, colour="speed")
        sets = list(xml.etree.ElementTree.parse(self.folder / "particles.pvd").iter("DataSet"))
        self.times = [float(s.get("timestep")) for s in sets]
        above = [sum(y > SHELF for _, y, _ in scene_runs.points_of(self.folder / s.get("file")))
                 for s in sets]
        self.areas = [WIDTH * height * count / above[0] for count in above]

    def heights(self):
        """Mean height of the filling over time [m]."""
        return [area / WIDTH for area in self.areas]

    def rate(self, above, below=math.inf):
        """Area a second [m2/s] while the filling's mean height is between the two [m]; None where
        that is too short to tell."""
        first = bisect.bisect_left(self.times, STARTED)
        points = [(t, a) for t, a in list(zip(self.times, self.areas))[first:]
                  if above <= a / WIDTH <= below]
        if len(points) < 8:
            return None
        return -common.slope(points)


def shown(rate):
    return "-" if rate is None else f"{rate:.3f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("silo-runs"))
    parser.add_argument("--tol", type=float, default=1e-3)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    sand = [Discharge(args, height, USUAL) for height in HEIGHTS]
    liquid = [Discharge(args, height, USUAL, liquid=True) for height in HEIGHTS]
    wider = [Discharge(args, FILLED, outlet) for outlet in OUTLETS]

    bands = [(low, low + 0.15) for low in (0.9, 0.75, 0.6, 0.45, 0.3)]
    lines = ["# Discharge of a silo", "",
             f"`scripts/silo_discharge.py {args.out} --tol {args.tol:g}`", "",
             f"Plane flow, silo {WIDTH} m wide with a flat floor, walls of mu = 0.3, cells of 25 mm. "
             "Rates are the area of densest sand that leaves a second [m2/s], once the flow has "
             f"started ({STARTED} s). *Liquid*: mu = 0 between smooth walls.", "",
             "![discharge](silo-discharge.svg)", "",
             "## Height of the filling", "", f"Outlet {USUAL} m. Rates while the mean height of what "
             "is left is in a band:", "",
             "| filling | first height [m] | " +
             " | ".join(f"{low:.2f} to {high:.2f} m" for low, high in bands) + " |",
             "|---|---|" + "---|" * len(bands)]
    for run in sand + liquid:
        lines.append(f"| {'liquid' if run.liquid else 'sand'} | {run.height} | " +
                     " | ".join(shown(run.rate(*band)) for band in bands) + " |")
    rates = {kind: [r for run in runs for band in bands if (r := run.rate(*band))]
             for kind, runs in (("sand", sand), ("the liquid", liquid))}
    for kind, found in rates.items():
        lines += ["", f"Largest over smallest rate of {kind}: {max(found) / min(found):.2f}."]
    lines += ["", "## Width of the outlet", "",
              f"Filled to {FILLED} m, rates while more than half of that is left:", "",
              "| outlet W [m] | cells | rate [m2/s] | rate / (sqrt(g) W^1.5) |", "|---|---|---|---|"]
    widths = [(run.outlet, run.rate(0.5 * run.height)) for run in wider]
    if any(rate is None for _, rate in widths):
        raise SystemExit("a run is too short to tell its rate")
    for outlet, rate in widths:
        lines.append(f"| {outlet} | {outlet / 0.025:.0f} | {rate:.3f} | "
                     f"{rate / math.sqrt(9.81) / outlet ** 1.5:.2f} |")
    lines += ["", f"Exponent of W, by least squares: {common.exponent(widths):.2f}. In plane flow it is 3/2 "
              "where only the width of the outlet and g count (Beverloo, Leniger, van de Velde, Chem. "
              "Eng. Sci. 15 (1961), quoted second hand; grains of no size)."]
    (args.out / "silo-discharge.md").write_text("\n".join(lines) + "\n")

    plt = scene_runs.plotting()
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    for run in sand + liquid:
        axes[0].plot(run.times, run.heights(), "C0--" if run.liquid else "k-", lw=1.2)
    axes[0].plot([], [], "k-", label="sand, mu = 0.4")
    axes[0].plot([], [], "C0--", label="liquid, mu = 0")
    axes[0].set(xlabel="time [s]", ylabel="mean height of the filling [m]",
                title=f"Outlet {USUAL} m, four fillings", ylim=(0, None))
    axes[0].legend()
    axes[1].loglog(*zip(*widths), "ko", label="sand")
    outlet, rate = widths[-1]
    axes[1].loglog(OUTLETS, [rate * (w / outlet) ** 1.5 for w in OUTLETS], "C3-", label="W^1.5")
    axes[1].set(xlabel="width of the outlet W [m]", ylabel="rate [m2/s]",
                title=f"Filled to {FILLED} m")
    axes[1].minorticks_off()
    axes[1].set_xticks(OUTLETS, [f"{w:g}" for w in OUTLETS])
    axes[1].set_yticks([r for _, r in widths], [f"{r:.2f}" for _, r in widths])
    axes[1].legend()
    scene_runs.save(figure, args.out / "silo-discharge.svg")


if __name__ == "__main__":
    main()
