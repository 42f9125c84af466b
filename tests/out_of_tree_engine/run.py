#!/usr/bin/env python3
"""An engine outside the tree, as its author would build it: installs this build under a prefix of
its own, builds the engine against it, runs it, and solves what it wrote with the installed program.

    run.py BUILD_DIR WORK_DIR [CMAKE_ARGUMENT]...

Then a program of all installed headers, one with a component that is not there, and the manual and
the completion are looked at where they were installed.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
BUILD, WORK = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
ARGUMENTS = sys.argv[3:]
PREFIX = WORK / "prefix"
PROGRAM = PREFIX / "bin/conebench"
STEPS = 20


def call(*command, code=0, **options):
    command = [str(word) for word in command]
    ran = subprocess.run(command, text=True, capture_output=True, **options)
    if ran.returncode != code:
        sys.exit(f"{' '.join(command)}: exit {ran.returncode}, expected {code}\n{ran.stdout}{ran.stderr}")
    return ran


def configure(source, build, *arguments, **options):
    return call("cmake", "-S", source, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={PREFIX}",
                *ARGUMENTS, *arguments, **options)


def build(source, *arguments):
    """Outside the tree: a header that was not installed is not found."""
    copy, folder = WORK / source.name, WORK / (source.name + "-build")
    shutil.copytree(source, copy)
    configure(copy, folder, *arguments)
    call("cmake", "--build", folder, "-j1")
    return folder / source.name


def install():
    call("cmake", "--install", BUILD, "--prefix", PREFIX)
    for file in ["share/man/man1/conebench.1.gz", "share/bash-completion/completions/conebench",
                 "share/doc/conebench/copyright", "share/doc/conebench/docs/file-format.md",
                 "include/conebench/harness/plugin_api.h"]:
        assert (PREFIX / file).is_file(), f"{file} is not installed"
    exported = "".join(path.read_text() for path in PREFIX.rglob("conebenchTargets*.cmake"))
    for leak in ["conebench_build", str(BUILD), str(HERE.parent.parent), "-Werror", "-march"]:
        assert leak not in exported, f"the exported targets name {leak}"


def engine():
    """The engine checks the motion; here its files are read, judged and solved anew."""
    files = WORK / "problems"
    print(call(build(HERE / "pushed_blocks"), files).stdout)
    verdicts = json.loads(call(PROGRAM, "problem", "verify", files, "--json").stdout)
    assert len(verdicts) == STEPS, f"{len(verdicts)} problems, expected {STEPS}"
    for verdict in verdicts:
        assert verdict["ok"] and verdict["eta"] <= 1e-9, verdict
    for solver in ["auto", "ipm"]:
        file = files / f"pushed-blocks_{STEPS - 1:06}.h5"
        answer = json.loads(call(PROGRAM, "solve", file, "-s", solver, "--tol", "1e-8", "--json").stdout)
        assert answer["status"] == "converged" and answer["eta"] <= 1e-8, answer


def all_headers():
    call(build(HERE / "all_headers", f"-Dconebench_INCLUDE={PREFIX}/include/conebench"))


def unknown_component():
    """find_package() says what there is."""
    source = WORK / "unknown"
    source.mkdir()
    (source / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(unknown LANGUAGES CXX)\n"
        "find_package(conebench REQUIRED COMPONENTS solvers sovlers)\n")
    ran = configure(source, WORK / "unknown-build", code=1)
    assert "known: problems, solvers, dem, mpm, results" in " ".join(ran.stderr.split()), ran.stderr


if __name__ == "__main__":
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    os.environ.pop("CMAKE_PREFIX_PATH", None)
    for check in [install, engine, all_headers, unknown_component]:
        check()
        print(f"{check.__name__}: ok")
    shutil.rmtree(WORK)
