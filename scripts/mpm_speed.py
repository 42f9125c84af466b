#!/usr/bin/env python3
"""Milliseconds of an MPM step, by grid and solver, and where they go.

    mpm_speed.py OUT.md [--program conebench] [--tol 1e-5] [--steps 40] [--limit 10]

Collapse of sand-column on 80x20, 160x40, 320x80 cells and of sand-door (24x4x12, 48x8x24; the door
opens at once), `gs`, `auto`, `prox-newton` and `ipm` one after the other in one run. A step that
--limit seconds end counts as not converged. Export is timed by two more runs at a tolerance of 0.1, of which one
writes every step.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import common

CASES = (
    ("2D 80x20", "sand-column", {"grid.cells": "[80,20]"}, 111),
    ("2D 160x40", "sand-column", {"grid.cells": "[160,40]", "step_s": 2e-3}, 490),
    ("2D 320x80", "sand-column", {"grid.cells": "[320,80]", "step_s": 1e-3}, 5084),
    ("3D 24x4x12", "sand-door", {"barriers[0].opens_s": 0}, 116),
    ("3D 48x8x24", "sand-door",
     {"grid.cells": "[48,8,24]", "barriers[0].opens_s": 0, "step_s": 2e-3}, None),
)


def command(args, verb, scene, settings, solver, steps):
    parts = [str(args.program), verb, scene, "-s", solver, "--steps", str(steps)]
    wanted = {**settings, "solver.tol": args.tol, "solver.time_limit_s": args.limit}
    for key, value in wanted.items():
        parts += ["--set", f"{key}={value}"]
    return parts


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--tol", type=float, default=1e-5)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--limit", type=float, default=10)
    args = parser.parse_args()
    lines = ["# Speed of the MPM engine", "",
             f"`scripts/mpm_speed.py {args.out} --tol {args.tol:g} --steps {args.steps} "
             f"--limit {args.limit:g}`", "", f"Machine: {common.machine()}, one core.", "",
             "| grid | cones | solver | ms a step | solver | assembly | transfers | export, ms | "
             "steps above tol | Sand6, ms | gs / this |", "|---|---|---|---|---|---|---|---|---|---|---|"]
    for name, scene, settings, sand6 in CASES:
        times = {}
        for solver in ("gs", "auto", "prox-newton", "ipm"):
            s = json.loads(subprocess.run(
                command(args, "simulate", scene, settings, solver, args.steps) + ["--json"],
                check=True, capture_output=True, text=True).stdout)
            whole = s["solve_s"] + s["assembly_s"] + s["transfer_s"]
            times[solver] = whole
            export = ""
            if solver == "auto":
                with tempfile.TemporaryDirectory() as folder:
                    few = max(4, args.steps // 5)
                    loose = ["--set", "solver.tol=0.1"]
                    start = time.monotonic()
                    subprocess.run(command(args, "simulate", scene, settings, solver, few) + loose,
                                   check=True, capture_output=True)
                    middle = time.monotonic()
                    subprocess.run(command(args, "export", scene, settings, solver, few) + loose +
                                   ["-o", folder], check=True, capture_output=True)
                    export = f"{(time.monotonic() - 2 * middle + start) / few * 1e3:.0f}"
            lines.append(
                f"| {name} | {s['cones_most']} | {solver} | {whole / s['steps'] * 1e3:.0f} | "
                f"{s['solve_s'] / whole:.1%} | {s['assembly_s'] / whole:.1%} | "
                f"{s['transfer_s'] / whole:.1%} | {export} | {s['steps_not_converged']} of "
                f"{s['steps']} | {sand6 or ''} | {times['gs'] / whole:.2f} |")
            args.out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
