#!/usr/bin/env python3
"""The problem file that examples/export/write_problem.py writes: read, verified, solved.

    from_python.py PROGRAM WORK_DIR

All blocks of the tower move as one: (60 N - 0.5 x 98.1 N) / 10 kg for a step of 1 ms.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

PYTHON = "/usr/bin/python3"  # Debian's, which has h5py
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "examples/export/write_problem.py"
PROGRAM, WORK = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
VELOCITIES = "import h5py, sys; print(*h5py.File(sys.argv[1])['solution/v'][0::2])"


def call(*command):
    return subprocess.run([str(word) for word in command], check=True, text=True, stdout=subprocess.PIPE).stdout


def main():
    if subprocess.run([PYTHON, "-c", "import h5py, numpy"], capture_output=True).returncode != 0:
        print("no h5py")
        sys.exit(1 if os.environ.get("CI") else 77)
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    file, solution = WORK / "tower.h5", WORK / "solution.h5"
    call(PYTHON, SCRIPT, file)
    (verdict,) = json.loads(call(PROGRAM, "problem", "verify", file, "--json"))
    assert verdict["ok"], verdict
    answer = json.loads(call(PROGRAM, "solve", file, "--tol", "1e-10", "-o", solution, "--json"))
    assert answer["status"] == "converged" and answer["problem"] == "tower_000000", answer
    velocities = [float(word) for word in call(PYTHON, "-c", VELOCITIES, solution).split()]
    expected = (60.0 - 0.5 * 5 * 2.0 * 9.81) / 10.0 * 1e-3
    assert len(velocities) == 5, velocities
    assert all(abs(v - expected) < 1e-10 for v in velocities), (velocities, expected)


if __name__ == "__main__":
    main()
