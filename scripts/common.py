"""What the scripts of this folder share."""
import csv
import json
import math
import pathlib
import platform
import statistics
import subprocess

PROGRAM = pathlib.Path(__file__).resolve().parent.parent / "build" / "conebench"


def run_json(command):
    done = subprocess.run([str(x) for x in command], capture_output=True, text=True)
    if not done.stdout.strip():
        raise RuntimeError(f"{command}: exit {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def machine():
    """The name of the processor, for the line "Machine: ..." of a table."""
    with open("/proc/cpuinfo") as info:
        return next((line.split(":", 1)[1].strip() for line in info
                     if line.startswith("model name")), platform.machine())


def slope(points):
    """Of a line through [(x, y)], by least squares."""
    return statistics.linear_regression(*zip(*points)).slope


def exponent(points):
    """n of y ~ x^n through [(x, y)], by least squares of the logarithms."""
    return slope([(math.log(x), math.log(y)) for x, y in points])


def shown(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def write_rows(path, names, rows):
    """Writes a CSV of dictionaries as they come, so that a stopped run leaves what it had."""
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, names)
        writer.writeheader()
        for row in rows:
            writer.writerow(row)
            file.flush()


def read_rows(path):
    """The rows of a CSV of numbers."""
    with open(path) as file:
        return [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]
