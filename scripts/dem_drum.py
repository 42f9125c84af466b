"""A drum's dynamic angle of repose against friction and rate (for dem_physics.py)."""
import math
import pathlib
import statistics

import scene_runs

SCENE = pathlib.Path(__file__).resolve().parent / "dem_drum.toml"
RADIUS, GRAVITY = 0.1, 9.81
RATE, FRICTION = 1.4, 0.5           # where the others are varied
RATES = (0.7, 1.4, 2.8, 5.6)        # [rad/s]
FRICTIONS = (0, 0.1, 0.2, 0.35, 0.7)
TURNED, MEASURED = 1.0, 1.5         # [rad] until the surface flows, and after it; but no less than
SHORTEST_S = 0.8                    # each


def angle_of(points):
    """Of the surface: the fill's centre of mass hangs perpendicularly below it. [degrees]"""
    x, z = (statistics.fmean(p[axis] for p in points) for axis in (0, 2))
    return math.degrees(math.atan2(x, -z))


def run(args, friction, rate, solver={}):
    folder = args.work / f"drum-{friction}-{rate}{'-fine' if solver else ''}"
    start = max(TURNED / rate, SHORTEST_S)
    settings = {"default_pair.friction": friction, "motions[0].rate_rad_s": rate,
                "duration_s": f"{start + max(MEASURED / rate, SHORTEST_S):.3f}"}
    summary = scene_runs.simulate(args.program, str(SCENE), folder, settings | solver,
                                  colour="speed")
    angles = [abs(angle_of(scene_runs.points_of(file)))
              for time, file in scene_runs.sphere_files(folder) if time >= start]
    return {"friction": friction, "rate_rad_s": rate, "froude": rate ** 2 * RADIUS / GRAVITY,
            "angle_deg": statistics.fmean(angles), "spread_deg": statistics.pstdev(angles),
            "steps_not_converged": summary["steps_not_converged"], "steps": summary["steps"]}


def rows(args):
    for rate in RATES:
        yield run(args, FRICTION, rate)
    for friction in FRICTIONS:
        yield run(args, friction, RATE)


def draw(rows_, path):
    plt = scene_runs.plotting()
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True)
    chosen = sorted((r for r in rows_ if r["rate_rad_s"] == RATE), key=lambda r: r["friction"])
    left.errorbar([r["friction"] for r in chosen], [r["angle_deg"] for r in chosen],
                  [r["spread_deg"] for r in chosen], fmt="ko-", capsize=3)
    left.plot([0, 0.7], [25, 25], "C2:", label="25 to 35 degrees")
    left.plot([0, 0.7], [35, 35], "C2:")
    mus = [0.02 * k for k in range(36)]
    left.plot(mus, [math.degrees(math.atan(mu)) for mu in mus], "C0--", label="arctan(mu)")
    left.set(xlabel="friction mu of grains and drum [-]", ylabel="angle of the surface [degrees]",
             title=f"at {RATE} rad/s", ylim=(0, None))
    left.legend()
    chosen = [r for r in rows_ if r["friction"] == FRICTION]
    right.errorbar([r["froude"] for r in chosen], [r["angle_deg"] for r in chosen],
                   [r["spread_deg"] for r in chosen], fmt="ko-", capsize=3)
    right.set(xlabel="Froude number omega^2 R / g [-]", title=f"at mu = {FRICTION}", xscale="log")
    scene_runs.save(figure, path)
