"""What the tests of whole campaigns share."""
import json
import pathlib
import sqlite3
import subprocess


def run(command, **options):
    return subprocess.run([str(x) for x in command], capture_output=True, text=True, **options)


def make_problems(program, folder, count):
    """Some small problems of a dry column, exported by the program itself."""
    done = run([program, "export", "column-dry", "-s", "gs", "--steps", count, "-o", folder])
    files = sorted(pathlib.Path(folder).glob("*.h5"))
    if not files:
        raise SystemExit(f"no problems: exit {done.returncode}: {done.stderr}")
    return files


def rows(results_dir):
    """The rows of results.db, in a fixed order: identity and everything that does not depend on time.
    """
    with sqlite3.connect(pathlib.Path(results_dir) / "results.db") as store:
        return sorted(store.execute(
            "select content_sha256, solver, tol, mode, repetition, status, eta, iterations "
            "from record"))


def journal_lines(results_dir):
    """Complete lines of all journals, one identity each."""
    identities = []
    for path in sorted(pathlib.Path(results_dir).glob("journal*.jsonl")):
        for line in path.read_text(errors="replace").splitlines():
            try:
                record = json.loads(line)
            except json.JSONDecodeError:
                continue
            identities.append((record["content_sha256"], record["solver"], record["tol"],
                               record["mode"], record["repetition"]))
    return identities


def merge(program, results_dir):
    done = run([program, "merge", results_dir])
    if done.returncode != 0:
        raise SystemExit(f"merge: exit {done.returncode}: {done.stderr}")
