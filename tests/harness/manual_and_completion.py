#!/usr/bin/env python3
"""The manual and the completion against what the program says with --help.

    manual_and_completion.py PROGRAM

Every verb and option that any --help lists stands in the manual, in its verb's section, and is
offered by bash itself, which is asked here; groff and man find nothing to complain about.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
QUERY = r"""
source "$1"
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
while IFS= read -r COMP_LINE; do
  COMP_POINT=${#COMP_LINE}
  COMPREPLY=()
  _conebench
  printf '%s\n' "${COMPREPLY[@]}" ''
  printf -- '--end--\n'
done
"""


def output(*arguments, **options):
    return subprocess.run(arguments, check=True, text=True, capture_output=True, **options).stdout


def conebench(*arguments):
    return output(str(PROGRAM), *arguments)


def helped(path=()):
    """Verb path -> (options, verbs below), as --help lists them, of this verb and those below."""
    options, verbs, part = [], [], ""
    for line in conebench(*path, "--help").splitlines():
        if re.fullmatch(r"(Options|Subcommands|Positionals|Start here|Exit codes):", line):
            part = line[:-1]
        elif not line.strip():
            part = ""
        elif part == "Options" and re.match(r"  -", line):
            options += line.split()[0].split(",")
        elif part == "Subcommands" and re.match(r"  \w", line):
            verbs.append(line.split()[0])
    found = {path: (options, verbs)}
    for verb in verbs:
        found |= helped((*path, verb))
    return found


def check_manual(tree, folder):
    source = folder / "conebench.1"
    conebench("manual", "-o", str(source))
    assert source.read_text() == conebench("manual")
    ran = subprocess.run(["groff", "-ww", "-man", "-Tutf8", "-P-cbou", "-rLL=200n", source], text=True,
                         capture_output=True)
    assert ran.returncode == 0 and ran.stderr == "", ran.stderr
    assert "\\" not in ran.stdout, "an escape was printed"
    if shutil.which("man"):
        viewed = subprocess.run(["man", "--warnings", "-l", source], text=True, capture_output=True,
                                env=os.environ | {"MANWIDTH": "100", "LC_ALL": "C.UTF-8"})
        assert viewed.returncode == 0 and viewed.stderr == "", viewed.stderr
        assert "EXIT STATUS" in viewed.stdout

    name, sections = "", {"": ""}
    for line in ran.stdout.splitlines():
        heading = re.fullmatch(r"(?:   )?(\S.*)", line)
        if heading:
            name = heading.group(1)
            sections[name] = ""
        else:
            sections[name] += line + "\n"
    for path, (options, _) in tree.items():
        section = " ".join(path) or "OPTIONS"
        assert section in sections, f"the manual has no section {section}; it has {list(sections)}"
        said = re.split(r"[\s,]+", sections[section])
        for option in options:
            assert option in said, f"the manual does not name {option} of {section}"
    for code in ["0", "1", "2", "3", "4", "130"]:
        assert re.search(rf"^ +{code} ", sections["EXIT STATUS"], re.MULTILINE), f"no exit code {code}"
    print(f"manual: {len(tree)} sections, {sum(len(options) for options, _ in tree.values())} options")


class Bash:
    """Answers of the completion to lines that end where the cursor is."""

    def __init__(self, folder):
        self.script = folder / "conebench.bash"
        conebench("completion", "-o", str(self.script))
        assert self.script.read_text() == conebench("completion")
        self.folder = folder

    def __call__(self, *lines):
        ran = subprocess.run(["bash", "-c", QUERY, "bash", self.script], text=True, capture_output=True,
                             input="".join(line + "\n" for line in lines), cwd=self.folder)
        assert ran.returncode == 0 and ran.stderr == "", ran.stderr
        answers = ran.stdout.split("--end--\n")[:-1]
        assert len(answers) == len(lines)
        return [set(answer.split("\n")) - {""} for answer in answers]


def check_tree(tree, bash):
    lines = []
    for path in tree:
        lines += [" ".join(("conebench", *path, "-")), " ".join(("conebench", *path, ""))]
    answers = bash(*lines)
    for (path, (options, verbs)), offered, below in zip(tree.items(), answers[::2], answers[1::2]):
        assert offered == set(options), f"{path}: offers {offered}, --help lists {options}"
        if verbs:
            assert below == set(verbs), f"{path}: offers {below}, --help lists {verbs}"


def check_values(bash):
    solvers = {method["name"] for method in json.loads(conebench("solver", "list", "--json"))}
    scenes = {scene["name"] for scene in json.loads(conebench("scene", "list", "--json"))}
    (bash.folder / "problems").mkdir()
    for file in ["mine.so", "scene.toml", "problem.h5"]:
        (bash.folder / file).touch()
    files = {"mine.so", "scene.toml", "problem.h5", "problems", "conebench.1", "conebench.bash"}
    expected = {
        "conebench solve problem.h5 -s ": solvers | {"plugin:", "exec:"},
        "conebench run -p problems -s gs ": solvers | {"plugin:", "exec:"},
        "conebench run --stop own -s gs newton-a": {"newton-ac"},
        "conebench solve problem.h5 --solver newton-f": {"newton-fb"},
        "conebench solve problem.h5 --solver=newton-f": {"newton-fb"},
        "conebench solve -s plugin:mi": {"mine.so"},
        "conebench solver show newton-a": {"newton-ac"},
        "conebench simulate column-d": {"column-dry"},
        "conebench simulate ": scenes | {"scene.toml", "problems"},
        "conebench scene show sc": {"scene.toml"},
        "conebench export column-dry -o ": {"problems"},
        "conebench export column-dry --policy r": {"reservoir:"},
        "conebench run --stop ": {"common", "own"},
        "conebench run --mode cold w": {"warm"},
        "conebench problem export problem.h5 --format ": {"fclib", "conebench"},
        "conebench solver new mine --language ": {"c", "c++", "python"},
        "conebench problem verify ": files,
        "conebench problem verify problem.h5 mi": {"mine.so"},
        "conebench solve ": files,
        "conebench solve problem.h5 ": set(),
        "conebench solve --tol ": set(),
        "conebench run --tol 1e-4 1e-": set(),
        "conebench so": {"solver", "solve"},
        "conebench nonsense x": set(),
    }
    # Where colons part words, what stands before the last one is already on the line.
    if "siconos:nsgs" in solvers:
        expected["conebench solve problem.h5 -s siconos:nsg"] = {"nsgs"} | {
            name.removeprefix("siconos:") for name in solvers if name.startswith("siconos:nsg")}
    for (line, wanted), offered in zip(expected.items(), bash(*expected)):
        assert offered == wanted, f"'{line}': offers {sorted(offered)}, expected {sorted(wanted)}"
    print(f"completion: {len(expected)} kinds of value")


def check_completion(tree, folder):
    bash = Bash(folder)
    check_tree(tree, bash)
    check_values(bash)


def check_unwritable(folder):
    for verb in ["manual", "completion"]:
        ran = subprocess.run([PROGRAM, verb, "-o", folder / "none" / "file"], capture_output=True, text=True)
        assert ran.returncode == 3 and ran.stderr.count("\n") == 1, ran


def main():
    if not shutil.which("groff"):
        print("no groff")
        sys.exit(1 if os.environ.get("CI") else 77)
    tree = helped()
    assert len(tree) > 25 and len(tree[()][1]) > 15, f"only {len(tree)} verbs found in --help"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_manual(tree, folder)
        check_completion(tree, folder)
        check_unwritable(folder)


if __name__ == "__main__":
    main()
