"""Columns of discs: how far dry ones run out, how high cohesive ones stand (for dem_physics.py)."""
import math
import pathlib
import statistics

import run_outs
import scene_runs

SCENE = pathlib.Path(__file__).resolve().parent / "dem_column.toml"
DISC = 0.01          # mean diameter [m]
WEIGHT = 2500 * math.pi / 6 * DISC ** 3 * 9.81  # of the mean disc, which has a ball's mass [N]
GATE_S = 0.4         # when it goes, in SCENE
BONDED_S = 0.1       # how long bonds have to form before it goes
RATIOS = (0.6, 1.2, 2.4, 3.6, 5, 7, 11)  # of the loose fill; it settles by some 15 %
SEEDS = (1, 2, 3)
HEIGHTS = (8, 12, 16, 20)  # of the loose fill, in discs
HALVINGS = 5
WATCHED_S = 1.0      # a cohesive column, after the gate went
FALLEN = 0.15        # moved by more of the height than a column that sags and then stands


def column(width, height, floor, seconds, seed):
    return {"planes[1].point_m[0]": f"{width:g}", "columns[0].base_m[0]": f"{0.5 * width:g}",
            "columns[0].width_m": f"{width:g}", "columns[0].height_m": f"{height:g}",
            "beds[0].width_m": f"{2 * floor:g}", "duration_s": f"{seconds:.3f}", "seed": seed}


def grains(points):
    """Without the discs of the floor, whose centres are at 0."""
    return [p for p in points if p[2] != 0]


def when_gate_goes(folder, gate_s):
    return [file for time, file in scene_runs.sphere_files(folder) if time < gate_s][-1]


def at_end(folder):
    return grains(scene_runs.points_of(scene_runs.sphere_files(folder)[-1][1]))


def height_of(points):
    """Of a column with this centre of mass."""
    return 2 * statistics.fmean(z for _, _, z in points)


def run_out(args, ratio, seed, solver={}):
    width = 10 * DISC
    height = ratio * width
    fall = math.sqrt(2 * height / 9.81)
    settings = column(width, height, width * (3 + 4 * ratio ** 0.8), GATE_S + 4.5 * fall, seed)
    folder = args.work / f"dry-{ratio}-{seed}{'-fine' if solver else ''}"
    summary = scene_runs.simulate(args.program, str(SCENE), folder, settings | solver,
                                  colour="speed")
    before = grains(scene_runs.points_of(when_gate_goes(folder, GATE_S)))
    after = at_end(folder)
    places = sorted(x for x, _, _ in after)
    return {"ratio": ratio, "seed": seed, "discs": len(after),
            "aspect_ratio": height_of(before) / width,
            "run_out": (places[int(0.99 * len(places))] - width) / width,
            "final_height": max(z for _, _, z in after) / width,
            "moving_share": summary["energy"]["kinetic_J"] / summary["energy"]["initial_J"],
            "steps_not_converged": summary["steps_not_converged"], "steps": summary["steps"]}


def run_outs_rows(args):
    for ratio in RATIOS:
        for seed in SEEDS:
            yield run_out(args, ratio, seed)


def packing(args, height, seed):
    """A scene file with a column that was poured dry, and its floor's width. So that all strengths
    of bonds are tried on the same discs at the same places."""
    folder = args.work / f"poured-{height}-{seed}"
    floor = 3 * height * DISC
    width = 0.75 * height * DISC
    scene_runs.simulate(args.program, str(SCENE), folder,
                        column(width, height * DISC, floor, GATE_S, seed), colour="speed")
    last = scene_runs.sphere_files(folder)[-1][1]
    text = SCENE.read_text().replace("schema = 1", "schema = 1\nresolve = true")
    text = text[:text.index("[[columns]]")] + text[text.index("[[beds]]"):]
    for (x, _, z), radius in zip(scene_runs.points_of(last),
                                 scene_runs.numbers_of(last, "radius_m")):
        if z != 0:
            text += (f'\n[[bodies]]\nposition_m = [{x!r}, 0, {z!r}]\nradius_m = {radius!r}\n'
                     'material = "grain"\n')
    scene = folder / "poured.toml"
    scene.write_text(text)
    return scene, {"beds[0].width_m": f"{2 * floor:g}", "planes[1].until_s": BONDED_S,
                   "planes[1].point_m[0]": f"{width:g}"}


def falls(args, height, seed, bond):
    """Whether a tenth of the discs has moved by FALLEN of the height before; and that height."""
    scene, settings = packing(args, height, seed)
    settings |= {"pairs[0].tensile_force_N": f"{bond * WEIGHT:.6g}",
                 "duration_s": BONDED_S + WATCHED_S}
    folder = args.work / f"cohesive-{height}-{seed}-{bond:.4f}"
    scene_runs.simulate(args.program, str(scene), folder, settings, colour="speed")
    before = grains(scene_runs.points_of(when_gate_goes(folder, BONDED_S)))
    after = at_end(folder)
    tall = height_of(before)
    moved = sum(math.dist(p, q) > FALLEN * tall for p, q in zip(before, after))
    return moved > 0.1 * len(after), tall / DISC


def critical_bond(args, height, seed):
    """By halving, from bonds of 0 to as many weights as the column is high."""
    low, high = 0.0, float(height)
    stood = 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        down, tall = falls(args, height, seed, middle)
        if down:
            low = middle
        else:
            high, stood = middle, tall
    if not stood:
        raise RuntimeError(f"a column of {height} discs falls with bonds of {middle:g} weights, "
                           "expected it to stand")
    return {"seed": seed, "height": stood, "falls": low, "stands": high}


def critical_rows(args):
    for height in HEIGHTS:
        for seed in SEEDS:
            yield critical_bond(args, height, seed)


def two_sides_of_critical(args):
    """[(title, folder)] of a column just strong enough, and not quite."""
    height, seed = HEIGHTS[-1], SEEDS[0]
    found = critical_bond(args, height, seed)
    return [(f"{what} at F = {found[what]:.2f} m g",
             args.work / f"cohesive-{height}-{seed}-{found[what]:.4f}")
            for what in ("stands", "falls")]


def draw_run_outs(rows, path):
    plt = scene_runs.plotting()
    figure, axes = plt.subplots(figsize=(7, 5))
    axes.loglog([r["aspect_ratio"] for r in rows], [r["run_out"] for r in rows], "ko",
                label="conebench, discs, mu = 0.5, three seeds")
    ratios = [0.5 * 1.05 ** k for k in range(58)]
    for (name, scaling), style in zip(run_outs.SCALINGS, ("C0--", "C1-.")):
        axes.loglog(ratios, [scaling(a) for a in ratios], style, label=name)
    axes.set(xlabel="aspect ratio a = H / L [-]", ylabel="run-out (L_end - L) / L [-]",
             title="Run-out of dry columns of discs")
    axes.legend()
    scene_runs.save(figure, path)


def draw_critical(rows, path):
    plt = scene_runs.plotting()
    figure, axes = plt.subplots(figsize=(7, 5))
    for row in rows:
        axes.plot([row["falls"], row["stands"]], [row["height"]] * 2, "k-", lw=2)
    share = per_bond(rows)
    most = max(row["stands"] for row in rows)
    axes.plot([0, most], [0, share * most], "C0--", label=f"H = {share:.2f} d F / (m g)")
    axes.set(xlabel="strength of a bond over a disc's weight F / (m g) [-]",
             ylabel="height over mean diameter H / d [-]",
             title="Cohesive columns: each bar from falling to standing", xlim=(0, None),
             ylim=(0, None))
    axes.legend()
    scene_runs.save(figure, path)


def per_bond(rows):
    """Critical height over d F / (m g): the slope of the line through 0."""
    pairs = [(0.5 * (row["falls"] + row["stands"]), row["height"]) for row in rows]
    return sum(x * y for x, y in pairs) / sum(x * x for x, _ in pairs)
