#!/usr/bin/env python3
"""Kills a campaign at random moments and compares what it comes to with an uninterrupted one.

    unbreakable.py CONEBENCH [--times 100] [--seed 1]

Each time one of: SIGKILL for the program, SIGKILL for one of its workers, SIGINT, or a full disk
(a limit on the size of the journal). After each the same command runs again. At the end the merged
store must equal that of the uninterrupted campaign, and no task may stand in the journal twice.
"""
import argparse
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

import common

SOLVERS = ["gs", "newton-ac", "spg", "auto"]
ACTIONS = ("kill the program", "kill a worker", "interrupt", "full disk")


def campaign(program, problems, results_dir, repetitions):
    return [str(x) for x in [program, "run", "-p", *problems, "-s", *SOLVERS, "--tol", 1e-6,
                             "--time-limit", "10s", "--reps", repetitions, "-o", results_dir]]


def descendants(pid):
    found, todo = [], [pid]
    while todo:
        try:
            children = pathlib.Path(f"/proc/{todo[0]}/task/{todo[0]}/children").read_text().split()
        except OSError:
            children = []
        todo = todo[1:] + [int(c) for c in children]
        found += [int(c) for c in children]
    return found


def quietly_kill(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def full_disk(bytes_left):
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_left, bytes_left))
    return limit


def disturb(command, action, journal, rng, whole_s):
    """Runs the command and disturbs it once. True if it ended undisturbed."""
    disk = None
    if action == "full disk":
        size = journal.stat().st_size if journal.exists() else 0
        disk = full_disk(size + rng.randrange(1, 20000))
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=disk)
    if disk is None:
        time.sleep(rng.uniform(0.0, whole_s))
        if action == "kill a worker":
            victims = descendants(process.pid)
            if victims:
                quietly_kill(rng.choice(victims), signal.SIGKILL)
        else:
            quietly_kill(process.pid,
                         signal.SIGINT if action == "interrupt" else signal.SIGKILL)
    return process.wait() == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--times", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    rng = random.Random(args.seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        problems = common.make_problems(args.program, folder / "problems", 12)
        whole, broken = folder / "whole", folder / "broken"
        repetitions = 3
        start = time.monotonic()
        subprocess.run(campaign(args.program, problems, whole, repetitions), check=True,
                       capture_output=True)
        whole_s = time.monotonic() - start
        command = campaign(args.program, problems, broken, repetitions)
        counts = dict.fromkeys(ACTIONS, 0)
        finished = 0
        for _ in range(args.times):
            action = rng.choice(ACTIONS)
            counts[action] += 1
            # Short lives, so that there is something left to disturb for most of the time.
            if disturb(command, action, broken / "journal.jsonl", rng, 0.1 * whole_s):
                finished += 1
                for results in broken.glob("journal*.jsonl"):
                    lines = results.read_text().splitlines(keepends=True)
                    results.write_text("".join(lines[: len(lines) // 3]))
        subprocess.run(command, check=True, capture_output=True)
        for results in (whole, broken):
            common.merge(args.program, results)
        lines = common.journal_lines(broken)
        expected = len(problems) * len(SOLVERS) * repetitions
        print(f"{args.times} disturbances ({', '.join(f'{n} x {a}' for a, n in counts.items())}), "
              f"{finished} times the campaign ended before and was cut back to a third; "
              f"{expected} tasks, {len(lines)} lines, uninterrupted {whole_s:.1f} s")
        if len(lines) != expected or len(set(lines)) != expected:
            sys.exit(f"{expected} tasks, but {len(lines)} lines of {len(set(lines))} tasks")
        if common.rows(whole) != common.rows(broken):
            sys.exit("the merged stores differ")


if __name__ == "__main__":
    main()
