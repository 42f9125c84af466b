#!/usr/bin/env python3
"""Nothing stands in a problem file that docs/file-format.md does not name.

    file_reference.py PROGRAM

Looks at made problems of both forms and at steps of both engines, with geometry, guess and solution.
Run by Debian's Python, which has h5py.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:
    print("no h5py")
    sys.exit(1 if os.environ.get("CI") else 77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def documented():
    text = (ROOT / "docs/file-format.md").read_text()
    return {part for quoted in re.findall(r"`([^`\n]+)`", text) for part in quoted.split("/")}


def names_in(path):
    names = set()
    with h5py.File(path) as file:
        names.update(file.attrs)
        file.visit(lambda name: names.update([*name.split("/"), *file[name].attrs]))
    return names


def export(scene, folder):
    subprocess.run([PROGRAM, "export", scene, "-o", folder / scene, "--steps", "3"], check=True,
                   capture_output=True)
    return sorted((folder / scene).glob("*.h5"))


def main():
    known, seen = documented(), set()
    with tempfile.TemporaryDirectory() as name:
        files = sorted((ROOT / "tests/data/ci-problems").glob("*.h5"))
        for scene in ["column-cohesive", "sand-column"]:
            files += export(scene, pathlib.Path(name))
        for file in files:
            found = names_in(file)
            assert found <= known, f"{file}: docs/file-format.md does not name {sorted(found - known)}"
            seen |= found
    for expected in ["rate_unit", "theta", "indptr", "W", "frames", "volume_fraction", "guess", "eta", "fclib_local"]:
        assert expected in seen, f"no file has {expected}"
    print(f"{len(seen)} names in {len(files)} files")


if __name__ == "__main__":
    main()
