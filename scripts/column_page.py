"""The page of dem_against_mpm.py: what was compared, how, and what it says."""
import math

import column_figures
import column_measures
import columns_of_discs
import columns_of_sand
import common


def limits(rows, kind):
    """Of each packing, or grid and start: (name, (falls at, stands at))."""
    some = column_figures.of(rows, kind)
    return [(member, column_measures.limit([(r["strength"], r["stands"]) for r in some
                                            if r["member"] == member]))
            for member in dict.fromkeys(r["member"] for r in some)]


def shown_limit(low, high):
    if low is None:
        return "all stand"
    return f"{low:g} to {high:g}" if high is not None else f"above {low:g}"


def distance(args, rows, law, strength):
    """Of mean run-outs, and the share of material elsewhere in the mean profiles."""
    discs = column_figures.of(rows, "discs", strength)
    sand = column_figures.of(rows, law, strength)
    means = [[sum(p) / len(p) for p in zip(*(r["profile"] for r in some))]
             for some in (discs, sand)]
    return (column_figures.spread(sand, "run_out")[1] - column_figures.spread(discs, "run_out")[1],
            column_measures.gap(*means, args.span, columns_of_discs.WIDTH))


def noise(args, rows, strength):
    """The mean of how much of the material lies elsewhere in two packings of discs."""
    discs = column_figures.of(rows, "discs", strength)
    pairs = [column_measures.gap(a["profile"], b["profile"], args.span, columns_of_discs.WIDTH)
             for i, a in enumerate(discs) for b in discs[i + 1:]]
    return sum(pairs) / len(pairs)


def ranged(rows, key):
    low, mean, high = column_figures.spread(rows, key)
    return f"{mean:.2f} ({low:.2f} to {high:.2f})"


def table(args, rows, key):
    lines = ["| c / (rho g H) | " + " | ".join(column_figures.KINDS) + " |",
             "|---|" + "---|" * len(column_figures.KINDS)]
    for c in args.strengths:
        lines.append(f"| {c:g} | " + " | ".join(
            ranged(column_figures.of(rows, kind, c), key) for kind in column_figures.KINDS) + " |")
    return lines


def how(args, known, rows):
    discs = column_figures.of(rows, "discs")
    bonded = [r for r in discs if r["bond"]]
    contacts = sum(r["bonds_a_disc"] for r in bonded) / len(bonded)
    rumpf = sum(r["rumpf"] / r["strength"] for r in bonded) / len(bonded)
    tall = known["tall"]
    return [
        "## What is compared", "",
        f"A column of {discs[0]['discs']} discs of 8 to 12 mm between a smooth wall and a smooth "
        f"gate, {columns_of_discs.WIDTH / 0.01:.0f} mean diameters wide, on a floor of glued "
        "discs, "
        f"poured dry, H = {tall * 100:.1f} cm high (twice the height of its centre of mass above "
        "the floor, mean of "
        f"{len(args.seeds)} packings). Contacts get bonds of strength F, a contact point, and "
        "0.1 s later the gate goes. Beside it a column of sand of the same width and height on a "
        "rough floor against a slip wall. Both are "
        f"watched for {columns_of_discs.SECONDS:g} s, "
        f"{columns_of_discs.SECONDS / (2 * tall / 9.81) ** 0.5:.1f} times the free fall from H.",
        "",
        f"*Uncertainty*: DEM, {len(args.seeds)} packings; MPM, {len(args.grids)} grids "
        f"({', '.join(map(str, args.grids))} cells a width), each from a regular start and from one "
        "disturbed by half of a particle's room. All intervals are from the least to "
        "the largest. *Front*: 99 % of the material is behind it. *Fallen*: moved by more than "
        f"{column_measures.FALLEN:g} H; a column *stands* when at most "
        f"{100 * column_measures.STANDS:.0f} % of it has fallen. *Profile*: the height that the "
        "material over a place has at the packing of the start, so that areas are shares of it.",
        "",
        "**Friction.** Discs have mu = 0.5 at their contacts; sand has mu = sin(phi) of the "
        "continuum, which contacts do not give by themselves: discs roll. It is calibrated on one "
        "number, the dry run-out: straight between the frictions tried on "
        f"{args.grids[1]} cells, mean of both starts, ("
        + ", ".join(f"{mu:g}: {far:.2f}" for mu, far in known["tried"])
        + f"), discs {known['run_out']:.2f}. So mu = {known['friction']:.3f}, an angle of "
        f"{math.degrees(math.asin(known['friction'])):.0f} degrees; single packings ask for "
        f"{known['frictions'][0]:.2f} to {known['frictions'][1]:.2f}. "
        "What agrees at c = 0 in run-out does so by construction; profiles and all cohesive "
        "columns are predictions.", "",
        "**Cohesion.** c is the shear strength at zero pressure; what matters is c / (rho g H). "
        "That of bonds is measured: the same packings, glued to their floor, which then falls "
        f"{columns_of_discs.PULL:g} g faster than free fall; the bonds at which they tear, by "
        f"{columns_of_discs.HALVINGS} halvings, give the uniaxial tensile strength T = "
        f"{columns_of_discs.PULL:g} rho g H, and in the plane T = 2 c / (1 + mu). Found: "
        + ", ".join(f"{low:.1f} to {high:.1f}" for _, (low, high) in known["pulled"])
        + f" weights of a disc. So c / (rho g H) = {known['per_bond']:.4f} F / (m g), "
        f"+- {100 * known['spread'] / known['per_bond']:.0f} % over packings, which is an "
        "uncertainty of every discs' c below. Rumpf's estimate, sigma = Z d F / (4 m g) rho g and "
        f"c = mu sigma, with the measured Z = {contacts:.2f} bonds a disc gives {rumpf:.2f} times "
        "that: an upper bound, where all bonds of a surface break at once.", ""]


def limits_table(rows):
    lines = []
    for kind in column_figures.KINDS:
        found = limits(rows, kind)
        lines += [f"| {kind} | " + " | ".join(member for member, _ in found) + " |",
                  "|---|" + "---|" * len(found),
                  "| c / (rho g H) | " + " | ".join(shown_limit(*ends) for _, ends in found)
                  + " |", ""]
    return lines


def laws_table(args, rows):
    lines = ["| c / (rho g H) | two packings | " + " | ".join(columns_of_sand.LAWS) + " |",
             "|---|---|" + "---|" * len(columns_of_sand.LAWS)]
    for c in args.strengths:
        cells = []
        for law in columns_of_sand.LAWS:
            front, elsewhere = distance(args, rows, law, c)
            cells.append(f"{100 * elsewhere:.0f} % ({front:+.2f})")
        lines.append(f"| {c:g} | {100 * noise(args, rows, c):.0f} % | " + " | ".join(cells) + " |")
    means = []
    for law in columns_of_sand.LAWS:
        some = [distance(args, rows, law, c) for c in args.strengths if c]
        means.append(f"{100 * sum(e for _, e in some) / len(some):.0f} % "
                     f"({sum(f for f, _ in some) / len(some):+.2f})")
    noises = [noise(args, rows, c) for c in args.strengths if c]
    lines.append(f"| mean, cohesive | {100 * sum(noises) / len(noises):.0f} % | "
                 + " | ".join(means) + " |")
    return lines


def missed(rows):
    lines = []
    for kind in column_figures.KINDS:
        some = column_figures.of(rows, kind)
        lines.append(f"{kind} {sum(r['missed'] for r in some)} of {sum(r['steps'] for r in some)} "
                     f"steps, {sum(r['seconds'] for r in some):.0f} s")
    return ("Steps that missed their tolerance on eta (discs: 1e-2, `gs[omega=1.3]`, at most 500 "
            "sweeps; sand: 1e-3, `auto`) and went on with the best answer, and the wall clock of "
            "engine and solver: " + "; ".join(lines) + ".")


def within(low, high, spans):
    """Whether a limit lies in what the limits `spans` take up together."""
    if low is None or high is None:
        return False
    return (low >= min(s[0] for s in spans if s[0] is not None)
            and high <= max(s[1] for s in spans if s[1] is not None))


def verdicts(args, rows):
    discs = [ends for _, ends in limits(rows, "discs")]
    flowing = [c for c in args.strengths
               if c and not any(r["stands"] for r in column_figures.of(rows, "discs", c))]
    lines = ["## What the numbers say", "",
             "Discs stand from " + ", ".join(shown_limit(*ends) for ends in discs)
             + " on (c / (rho g H), packing by packing). Where discs flow, "
             f"c / (rho g H) = {', '.join(f'{c:g}' for c in flowing)}:", "",
             "| law | limits among those of the discs | never stands up to "
             f"{args.strengths[-1]:g} | run-out less the discs', where they flow | columns of sand "
             "with a run-out among those of the discs there |", "|---|---|---|---|---|"]
    for law in columns_of_sand.LAWS:
        found = [ends for _, ends in limits(rows, law)]
        among = total = 0
        for c in flowing:
            low, _, high = column_figures.spread(column_figures.of(rows, "discs", c), "run_out")
            sand = column_figures.of(rows, law, c)
            among += sum(low <= r["run_out"] <= high for r in sand)
            total += len(sand)
        less = [distance(args, rows, law, c)[0] for c in flowing]
        lines.append(f"| {law} | {sum(within(*ends, discs) for ends in found)} of {len(found)} | "
                     f"{sum(high is None and low is not None for low, high in found)} | "
                     + (f"{min(less):+.2f} to {max(less):+.2f}" if less else "-")
                     + f" | {among} of {total} |")
    return lines + [""]


def page(args, known, rows):
    lines = ["# DEM against MPM: columns of discs and of sand", "",
             f"`scripts/dem_against_mpm.py {args.out}{' --quick' if args.quick else ''}`, machine: "
             f"{common.machine()}, one core.", "", "![pictures](pictures.svg)", "",
             "The last packing, and the finest grid from the disturbed start, at the end; x / L and "
             "height / L, colour by height at the start.", ""]
    lines += verdicts(args, rows)
    lines += how(args, known, rows)
    lines += ["## Run-out", "", "![run-outs](run-outs.svg)", "",
              "(x99 - L) / L: mean, and from the least to the largest.", ""]
    lines += table(args, rows, "run_out")
    lines += ["", "## For which c it stands", "", "![fallen](fallen.svg)", "",
              "From the strongest tried that falls to the weakest above it that stands:", ""]
    lines += limits_table(rows)
    lines += ["## Final profiles", "", "![profiles](profiles.svg)", "",
              "Share of the material that lies elsewhere than in the discs' mean profile, and in "
              "brackets the run-out less the discs'. *Two packings*: the same between two packings "
              "of discs, below which nothing can be told apart.", ""]
    lines += laws_table(args, rows)
    lines += ["", missed(rows), ""]
    return "\n".join(lines)
