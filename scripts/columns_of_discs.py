"""Columns of discs with bonds: set free, and pulled apart (for dem_against_mpm.py)."""
import math

import column_measures
import dem_collapse
import scene_runs

HEIGHT = 24         # of the loose fill, in discs; it settles by some 15 %
WIDTH = 0.75 * HEIGHT * dem_collapse.DISC  # as dem_collapse.packing() has it [m]
SECONDS = 1.0       # watched after the gate went
PULL = 0.25         # of gravity: how hard a column is pulled from the floor it is glued to
PULLED_S = 0.35
MOST_BOND = 24.0    # weights of a disc: surely holds
HALVINGS = 5
FLOOR = 0.5 * dem_collapse.DISC  # tops of the floor's discs [m]


def flat(points):
    """Places and heights above the floor."""
    return [(x, z - FLOOR) for x, _, z in points]


def height_of(points):
    """Of a column with this centre of mass."""
    return dem_collapse.height_of(points) - 2 * FLOOR


def run(args, seed, bond):
    """Set free with bonds of so many weights of a disc."""
    scene, settings = dem_collapse.packing(args, HEIGHT, seed)
    seconds = dem_collapse.BONDED_S + SECONDS
    settings |= {"pairs[0].tensile_force_N": f"{bond * dem_collapse.WEIGHT:.6g}",
                        "duration_s": seconds}
    folder = args.work / f"discs-{seed}-{bond:.3f}"
    summary = scene_runs.simulate(args.program, str(scene), folder, settings, colour="speed")
    before = dem_collapse.grains(
        scene_runs.points_of(dem_collapse.when_gate_goes(folder, dem_collapse.BONDED_S)))
    after = dem_collapse.at_end(folder)
    tall = height_of(before)
    past = scene_runs.history(folder)
    bonds = [b for t, b in zip(past["time_s"], past["bonds"]) if t < dem_collapse.BONDED_S][-1]
    return column_measures.measured(flat(before), flat(after), WIDTH, tall, args.span) | {
        "discs": len(after), "height_m": tall, "bonds_a_disc": 2 * bonds / len(after),
        "seed": seed, "bond": bond, "folder": folder, "steps": summary["steps"],
        "missed": summary["steps_not_converged"],
        "seconds": summary["solve_s"] + summary["engine_s"]}


def glued(args, seed):
    """The same discs on a floor that drops from under them, by PULL faster than they would fall."""
    scene, _ = dem_collapse.packing(args, HEIGHT, seed)
    text = scene.read_text()
    floor = [x for x, _, z in scene_runs.points_of(
        scene_runs.sphere_files(scene.parent)[-1][1]) if z == 0 and -0.01 < x < WIDTH + 0.01]
    beds, bodies = text.index("[[beds]]"), text.index("\n[[bodies]]")
    table = scene.with_name("drop.csv")
    rate, start = (1 + PULL) * 9.81, dem_collapse.BONDED_S
    rows = [(start + 1e-3 * k, -0.5 * rate * (1e-3 * k) ** 2)
            for k in range(round(1e3 * PULLED_S) + 2)]
    table.write_text("t_s,x_m,y_m,z_m\n" + "".join(f"{t!r},0,0,{z!r}\n" for t, z in rows))
    out = scene.with_name("glued.toml")
    out.write_text(
        text[:beds] + f'[[motions]]\nname = "drop"\nkind = "table"\nfile = "{table.name}"\n'
        + "".join(f'\n[[bodies]]\nposition_m = [{x!r}, 0, 0]\nradius_m = 0.005\n'
                  'material = "bed"\nmotion = "drop"\n' for x in floor) + text[bodies:])
    return out


def holds(args, seed, bond):
    """Whether a column hangs together on its dropping floor."""
    scene = glued(args, seed)
    strength = f"{bond * dem_collapse.WEIGHT:.6g}"
    folder = args.work / f"pulled-{seed}-{bond:.3f}"
    scene_runs.simulate(args.program, str(scene), folder, {
        "pairs[0].tensile_force_N": strength, "pairs[1].tensile_force_N": 1e3,
        "pairs[1].rupture_distance_m": 1e-3, "planes[1].point_m[0]": f"{WIDTH:g}",
        "planes[1].until_s": 10, "duration_s": dem_collapse.BONDED_S + PULLED_S}, colour="speed")
    first = scene_runs.points_of(
        dem_collapse.when_gate_goes(folder, dem_collapse.BONDED_S))
    last = scene_runs.points_of(scene_runs.sphere_files(folder)[-1][1])
    drop = min(q[2] for p, q in zip(first, last) if p[2] == 0)
    pairs = [(p, (x, y, z - drop)) for p, (x, y, z) in zip(first, last) if p[2] != 0]
    tall = height_of([p for p, _ in pairs])
    left = sum(math.dist(p, q) > column_measures.FALLEN * tall for p, q in pairs)
    return left <= column_measures.STANDS * len(pairs), tall


def tensile_length(args, seed):
    """The height that hangs from a bond's strength: uniaxial tensile strength over the weight of a
    volume, of bonds of one weight of a disc [m]; and the halves of the bracket it is known to."""
    low, high = 0.0, MOST_BOND
    tall = None
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        held, tall = holds(args, seed, middle)
        low, high = (low, middle) if held else (middle, high)
    if high == MOST_BOND:
        raise RuntimeError(f"bonds of {low:g} weights do not hold a column, expected them to")
    return PULL * tall / (0.5 * (low + high)), (low, high)
