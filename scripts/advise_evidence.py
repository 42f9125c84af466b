#!/usr/bin/env python3
"""What `conebench advise` promises, against runs of the scenes that it has not seen.

    advise_evidence.py OUT.md [--program conebench] [--work DIR] [--quick]

For six scenes of both engines, dry and cohesive:
  budget   what `auto` takes for a step of the scene on average, to two digits
  advise   chooses on one run of the scene and states a probability from a second one
  unseen   further runs, of other seeds (the brick wall, which nothing random makes, is hit
           elsewhere): every entrant on the same steps of them, from the engine's own guesses
  engine   one of the unseen runs with the policy, with `auto`, with the worst reasonable choice
Writes the tables to OUT.md. Answers kept in --work are not asked for again.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess

import common
import scene_runs

ENTRANTS = ("auto", "apgd", "gs", "gs[skip=10]", "gs[omega=1.3]", "prox-newton", "newton-ac", "ipm",
            "aclm", "spg")
JITTER = {"blocks[0].jitter": 0.5}  # without it no particle depends on the seed
BALLS = scene_runs.balls(64) | {"duration_s": 0.3}
SAND = JITTER | {"grid.cells": "[40,10]", "duration_s": 0.4}
WALL = {"walls[0].courses": 6, "walls[0].bricks": 4, "bodies[0].position_m[2]": 0.35,
        "duration_s": 0.1}
SCENES = (  # name, tolerance, settings: small enough for some ten minutes in all
    ("column-dry", 1e-4, BALLS),
    ("column-cohesive", 1e-3, BALLS),
    ("brick-wall-impact", 1e-3, WALL),
    ("sand-column", 1e-4, SAND),
    ("sand-column-cohesive", 1e-4, SAND),
    ("sand-door", 1e-3, JITTER | {"grid.cells": "[16,4,8]", "duration_s": 0.4}),
)
PATIENCE = 20  # budgets, after which advise gives up on a step


def variation(scene, number):
    """Settings of the run of that number; 1 and 2 are those that advise takes."""
    if scene != "brick-wall-impact" or number < 3:
        return {"seed": number}
    draw = random.Random(number)
    return {"bodies[0].position_m[0]": f"{draw.uniform(-0.3, 0.3):.3f}",
            "bodies[0].position_m[2]": f"{draw.uniform(0.15, 0.5):.3f}",
            "bodies[0].velocity_m_s[1]": f"{draw.uniform(4, 8):.3f}"}


class Asker:
    """Runs the program, once for each question."""

    def __init__(self, args):
        self.program, self.work = args.program, args.work
        self.work.mkdir(parents=True, exist_ok=True)

    def json(self, name, command):
        answer = self.work / f"{name}.json"
        asked = self.work / f"{name}.command"
        command = [str(x) for x in command]
        if not (answer.exists() and asked.exists() and asked.read_text() == " ".join(command)):
            print(name, flush=True)
            answer.write_text(json.dumps(common.run_json([self.program, *command])))
            asked.write_text(" ".join(command))
        return json.loads(answer.read_text())


def sets(settings):
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def simulate(ask, name, scene, settings, solver):
    ran = ask.json(name, ["simulate", scene, "-s", solver, "--json", *sets(settings)])
    rest = ran["engine_s"] if ran["engine"] == "dem" else ran["transfer_s"] + ran["assembly_s"]
    return {"solve_ms": 1e3 * ran["solve_s"] / ran["steps"],
            "step_ms": 1e3 * (ran["solve_s"] + rest) / ran["steps"],
            "missed": ran["steps_not_converged"] / ran["steps"]}


def two_digits(x):
    return float(f"{x:.1e}")


def wish(budget_s, tol):
    return ["--budget", f"{1e6 * budget_s:g}us", "--tol", f"{tol:g}"]


def times_on(ask, name, folder, solver, wished):
    """Seconds of each exported step, infinite where it was not solved."""
    told = ask.json(name, ["advise", folder, "-s", solver, "--json", *wished])
    return [math.inf if t is None else t
            for side in ("race", "validation") for t in told[side][0]["times_s"]]


class Case:
    """One scene: its budget, its advice, its unseen steps."""

    def __init__(self, ask, args, scene, tol, settings):
        self.ask, self.args, self.scene = ask, args, scene
        self.settings = settings | {"solver.tol": tol, "solver.time_limit_s": 2}
        usual = simulate(ask, f"{scene}-budget", scene, self.settings, "auto")
        self.step_budget_s = two_digits(1e-3 * usual["solve_ms"])
        self.policy = (args.work / f"{scene}.toml").resolve()
        self.advice = ask.json(f"{scene}-advice", [
            "advise", scene, "--samples", args.samples, "-o", self.policy, "--json",
            *wish(self.step_budget_s, tol), "--sample-time", "2min", *sets(self.settings)])
        self.budget_s = self.advice["solve_budget_s"]
        self.wish = wish(self.budget_s, tol)
        self.choice = self.advice["ladder"][0]["solver"]

    def unseen(self, number):
        return self.settings | variation(self.scene, number)

    def export(self, number):
        folder = self.args.work / f"{self.scene}-{number}"
        if not folder.exists():
            part = folder.with_suffix(".part")
            subprocess.run([str(self.args.program), "export", self.scene, "-o", str(part),
                            "--policy", f"reservoir:{self.args.steps}",
                            *sets(self.unseen(number))], check=True, capture_output=True)
            part.rename(folder)
        return folder

    def race(self):
        """{solver: [[seconds of each step] of each unseen run]}"""
        return {solver: [times_on(self.ask, f"{self.scene}-{number}-{solver}", self.export(number),
                                  solver, self.wish) for number in self.args.runs]
                for solver in ENTRANTS}


def within(times, budget_s):
    return sum(t <= budget_s for t in times) / len(times)


def joined(runs):
    return [t for run in runs for t in run]


def virtual_best(times):
    """Of each step the least time of any solver."""
    return [min(each) for each in zip(*(joined(runs) for runs in times.values()))]


def capped_ms(times, budget_s):
    """Mean time, a failure at what a solver is given."""
    return 1e3 * sum(min(t, PATIENCE * budget_s) for t in times) / len(times)


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|---" + "|---:" * (len(header) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def percent(x):
    return f"{100 * x:.0f} %"


def promise_table(cases, times):
    rows, kept, all_runs = [], 0, 0
    for case in cases:
        runs = times[case.scene][case.choice]
        shares = [within(run, case.budget_s) for run in runs]
        stated = case.advice["probability"]
        kept += sum(share >= stated for share in shares)
        all_runs += len(shares)
        rows.append([case.scene, f"{1e3 * case.step_budget_s:.3g} ms",
                     f"{case.advice['solves_per_step']:.1f}", f"`{case.choice}`",
                     f"{case.advice['validation_steps']}", f"{stated:.2f}",
                     f"{within(joined(runs), case.budget_s):.2f}",
                     ", ".join(f"{share:.2f}" for share in shares),
                     f"{sum(share >= stated for share in shares)} of {len(shares)}"])
    head = ["scene", "budget", "solves a step", "advice", "steps judged", "stated, at least",
            "unseen", "each run", "runs that keep it"]
    return table(head, rows), kept, all_runs


def single_best(cases, times):
    """Of one solver for everything, the best on the first unseen run of each scene."""
    return max(ENTRANTS, key=lambda solver: sum(
        within(times[c.scene][solver][0], c.budget_s) for c in cases))


def gap_table(cases, times):
    """Shares within the budget: the policy's choice between one solver for all and the oracle."""
    single = single_best(cases, times)
    rows, sums = [], [0.0] * 4
    for case in cases:
        mine = {solver: runs[1:] for solver, runs in times[case.scene].items()}
        share = {s: within(joined(mine[s]), case.budget_s) for s in ENTRANTS}
        best = max(ENTRANTS, key=share.get)
        line = [share[single], share[case.choice], share[best],
                within(virtual_best(mine), case.budget_s)]
        sums = [a + b / len(cases) for a, b in zip(sums, line)]
        rows.append([case.scene, percent(line[0]), f"{percent(line[1])} (`{case.choice}`)",
                     f"{percent(line[2])} (`{best}`)", percent(line[3])])
    rows.append(["mean", *(percent(x) for x in sums)])
    head = ["scene", f"`{single}`, single best", "advice", "best of the scene", "virtual best"]
    gap = sums[3] - sums[0]
    return table(head, rows), single, (sums[1] - sums[0]) / gap if gap > 0 else math.nan


def worst_reasonable(case, times):
    """The slowest of those that solve nine steps of ten, whatever they take."""
    mine = times[case.scene]
    able = [s for s in ENTRANTS
            if sum(map(math.isfinite, joined(mine[s]))) >= 0.9 * len(joined(mine[s]))]
    return max(able or ENTRANTS, key=lambda s: capped_ms(joined(mine[s]), case.budget_s))


def engine_table(cases, times):
    rows, ratios = [], []
    for case in cases:
        settings = case.unseen(case.args.runs[0])
        worst = worst_reasonable(case, times)
        ran = {name: simulate(case.ask, f"{case.scene}-engine-{name}", case.scene, settings, solver)
               for name, solver in (("policy", f"policy:{case.policy}"), ("auto", "auto"),
                                    ("worst", worst))}
        cells = [f"{r['solve_ms']:.3g} / {r['step_ms']:.3g} ms, {percent(r['missed'])}"
                 for r in ran.values()]
        cells[2] += f" (`{worst}`)"
        ratios.append([ran[name]["solve_ms"] / ran["policy"]["solve_ms"]
                       for name in ("auto", "worst")])
        rows.append([f"{case.scene}, `{case.choice}`", *cells])
    means = [math.exp(sum(map(math.log, column)) / len(column)) for column in zip(*ratios)]
    head = ["scene, advice", "with its policy", "`auto`", "worst reasonable choice"]
    return table(head, rows), means


def report(args, cases, times):
    promise, kept, runs = promise_table(cases, times)
    gap, single, closed = gap_table(cases, times)
    engine, (of_auto, of_worst) = engine_table(cases, times)
    command = "scripts/advise_evidence.py results/published/advise.md" + \
        (" --quick" if args.quick else "")
    note = f" {args.note}" if args.note else ""
    scatter = 50 / math.sqrt(args.steps)
    return f"""# What `conebench advise` promises, and what comes of it

    {command}

Machine: {common.machine()}.{note} Entrants: {", ".join(f"`{s}`" for s in ENTRANTS)}.
Budget: what `auto` takes for a step of the scene on average, so that many steps miss it with most
solvers. `advise` chose on {args.samples} steps of one run and judged on as many of a second; the
columns "unseen" are {len(args.runs)} further runs of each scene, {args.steps} steps of each. They
differ by the seed (of sand because its particles are jittered); in the brick wall, where nothing is
random, by where and how fast the ball hits it, and there `advise` chose and judged on windows of one
run in turn.

## Does the stated probability hold?

P(time <= budget and eta <= tol) of the solver advised, stated with a confidence of 0.95. A step of
cohesive sand takes several solves, which share its budget; one of each step is judged.

{promise}
{kept} of {runs} unseen runs have at least the stated share of their steps within the budget. The
share of a run of {args.steps} steps alone scatters by up to {scatter:.0f} points (one standard
deviation). The bound allows for steps of a run hanging together and takes the machine as it was: it
knows neither how much runs differ nor what else will be running.

## How much is there to gain by choosing?

Steps of the unseen runs but the first solved within the budget: by the one solver that was best over
all scenes in the first, by the one advised for the scene, by the best of the scene in hindsight, and
by the best of each step.

{gap}
The advice closes {percent(closed)} of the gap between `{single}` everywhere and the virtual best.

## What does an engine take?

One unseen run of each scene: milliseconds a step in the solver / in all, and the share of steps
that did not reach the tolerance. The worst reasonable choice is the slowest of the entrants that
solve nine steps of ten when given time.

{engine}
In geometric mean `auto` takes {of_auto:.2f} times, the worst reasonable choice {of_worst:.2f} times
the solver time of the policy.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("advise-evidence"))
    parser.add_argument("--quick", action="store_true", help="fewer steps and runs")
    parser.add_argument("--note", default="", help="a sentence on the state of the machine")
    args = parser.parse_args()
    args.samples, args.steps = (24, 12) if args.quick else (40, 20)
    args.runs = (3, 4) if args.quick else (3, 4, 5)
    ask = Asker(args)
    cases, times = [], {}
    for scene in SCENES:  # all of one before the next, so that the machine changes little meanwhile
        case = Case(ask, args, *scene)
        cases.append(case)
        times[case.scene] = case.race()
    args.out.write_text(report(args, cases, times))


if __name__ == "__main__":
    main()
