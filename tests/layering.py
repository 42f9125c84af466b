#!/usr/bin/env python3
"""Reads every #include line and checks who may include whom, and which libraries stay inside a folder.

    layering.py [ROOT]

Exit 1 and one line a breach.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)

# Folder -> folders of ours that it may include, itself understood.
MAY_INCLUDE = {
    "problems": set(),
    "solvers": {"problems"},
    "dem": {"problems"},
    "mpm": {"problems"},
    "results": {"problems"},
    "harness": {"problems", "solvers", "dem", "mpm", "results"},
}
# Libraries whose types must not stand in a header that crosses a folder.
PRIVATE_LIBRARIES = re.compile(
    r"<(hdf5|H5|Ip|coin|nlopt|cholmod|SuiteSparse|dmumps|openssl|SQLiteCpp|sqlite|"
    r"Bullet|LinearMath|bt[A-Z])")
# Headers that only their own folder may include.
INTERNAL = {"problems/hdf5_file.h", "results/store_connection.h"}
# The only files of an engine that make a Problem.
MAKES_PROBLEM = re.compile(r"\bProblem\s*\(\s*(problems::)?(PrimalData|ReducedData)|\bPrimalData\s*\{")


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s+(["<])([^">]+)[">]', line)
        if found:
            yield number, line.strip(), found.group(2)


def breaches():
    for folder, allowed in MAY_INCLUDE.items():
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            name = path.relative_to(ROOT).as_posix()
            for number, line, target in includes(path):
                other = target.split("/")[0]
                if other in MAY_INCLUDE and other != folder and other not in allowed:
                    yield f"{name}:{number}: {folder}/ includes {target}, allowed: {sorted(allowed)}"
                if target in INTERNAL and target.split("/")[0] != folder:
                    yield f"{name}:{number}: {target} is internal to its folder"
                if path.suffix == ".h" and PRIVATE_LIBRARIES.search(line) and name not in INTERNAL:
                    yield f"{name}:{number}: {line} in a header"
            if folder in ("dem", "mpm") and not path.stem.startswith("export"):
                for number, line in enumerate(path.read_text().splitlines(), 1):
                    if MAKES_PROBLEM.search(line):
                        yield f"{name}:{number}: makes a Problem outside {folder}/export.*"


def main():
    found = list(breaches())
    for line in found:
        print(line)
    files = sum(1 for folder in MAY_INCLUDE for p in (ROOT / folder).rglob("*") if p.suffix in (".h", ".cpp"))
    if files == 0:
        sys.exit(f"{ROOT}: no sources found")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
