"""The figures of dem_against_mpm.py."""
import column_measures
import columns_of_discs
import columns_of_sand
import scene_runs

STYLES = {"discs": ("k", "o", "-"), "dense-only": ("C0", "s", "-."),
          "dilation-aware": ("C1", "^", "--"), "monotone": ("C2", "D", ":")}
KINDS = ("discs",) + columns_of_sand.LAWS


def of(rows, kind, strength=None):
    return [r for r in rows if r["of"] == kind and strength in (None, r["strength"])]


def spread(rows, key):
    values = [r[key] for r in rows]
    return min(values), sum(values) / len(values), max(values)


def curves(args, rows, key, path, **settings):
    """A quantity against cohesion: means, from the least to the largest of each kind."""
    plt = scene_runs.plotting()
    figure, axes = plt.subplots(figsize=(7.5, 5))
    for index, kind in enumerate(KINDS):
        colour, mark, line = STYLES[kind]
        ends = [spread(of(rows, kind, c), key) for c in args.strengths]
        places = [c + 0.003 * (index - 1.5) for c in args.strengths]
        axes.errorbar(places, [m for _, m, _ in ends],
                      [[m - low for low, m, _ in ends], [high - m for _, m, high in ends]],
                      color=colour, marker=mark, ls=line, capsize=3, ms=5,
                      label="DEM, discs" if kind == "discs" else f"MPM, {kind}")
    axes.set(xlabel="cohesion c / (rho g H) [-]", **settings)
    axes.legend()
    return figure, axes, path


def draw_profiles(args, rows):
    plt = scene_runs.plotting()
    figure, grid = plt.subplots(2, len(args.strengths) // 2, sharex=True, sharey=True,
                                figsize=(3.4 * (len(args.strengths) // 2), 5.4))
    step = args.span / column_measures.BINS / columns_of_discs.WIDTH
    x = [step * (k + 0.5) for k in range(column_measures.BINS)]
    for axes, c in zip(grid.flat, args.strengths):
        for kind in KINDS:
            colour, _, line = STYLES[kind]
            profiles = list(zip(*(r["profile"] for r in of(rows, kind, c))))
            mean = [sum(p) / len(p) for p in profiles]
            if kind == "discs":
                axes.fill_between(x, [min(p) for p in profiles], [max(p) for p in profiles],
                                  color="0.8", step="mid")
            axes.plot(x, mean, line, color=colour, lw=1.5, drawstyle="steps-mid",
                      label="DEM, discs" if kind == "discs" else kind)
        axes.set(title=f"c / (rho g H) = {c:g}", xlim=(0, 4), ylim=(0, 1.15))
    for axes in grid[-1]:
        axes.set_xlabel("x / L [-]")
    for axes in grid[:, 0]:
        axes.set_ylabel("height / H [-]")
    grid[0, -1].legend(fontsize=8)
    scene_runs.save(figure, args.out / "profiles.svg")


def draw_pictures(args, rows):
    """The last packing, or grid and start, at the end; layers of the start in colour."""
    plt = scene_runs.plotting()
    chosen = [args.strengths[0], args.strengths[len(args.strengths) // 2], args.strengths[-1]]
    figure, grid = plt.subplots(len(chosen), len(KINDS), sharex=True, sharey=True,
                                figsize=(3.6 * len(KINDS), 1.55 * len(chosen)))
    width = columns_of_discs.WIDTH
    for line, c in zip(grid, chosen):
        for axes, kind in zip(line, KINDS):
            row = of(rows, kind, c)[-1]
            size = 13 if kind == "discs" else 7
            axes.scatter([x / width for x, _ in row["after"]], [y / width for _, y in row["after"]],
                         c=[y for _, y in row["before"]], cmap="viridis", s=size, lw=0)
            axes.set(xlim=(0, 3.2), ylim=(0, 1.15), aspect="equal")
            axes.set_title(f"{kind}, c = {c:g} rho g H", fontsize=9)
    figure.tight_layout(pad=0.4)
    scene_runs.save(figure, args.out / "pictures.svg")


def draw(args, rows):
    figure, _, path = curves(args, rows, "run_out", args.out / "run-outs.svg",
                             ylabel="run-out (x99 - L) / L [-]",
                             title="Run-out against cohesion")
    scene_runs.save(figure, path)
    figure, axes, path = curves(args, rows, "fallen", args.out / "fallen.svg",
                                ylabel=f"share that moved by more than "
                                       f"{column_measures.FALLEN:g} H [-]",
                                title="What falls")
    axes.axhline(column_measures.STANDS, color="0.5", lw=1)
    axes.text(args.strengths[-1], column_measures.STANDS + 0.01, "stands below", ha="right",
              color="0.4", fontsize=9)
    scene_runs.save(figure, path)
    draw_profiles(args, rows)
    draw_pictures(args, rows)
