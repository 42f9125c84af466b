"""Runs of scenes, kept from call to call, and what the scripts of this folder read from them."""
import csv
import json
import pathlib
import re
import subprocess
import xml.etree.ElementTree


def simulate(program, scene, folder, settings, frames=2, colour="fraction", steps=None):
    """Runs `scene` with settings {key: value} into `folder`, unless that has been done.
    Returns its summary."""
    folder = pathlib.Path(folder)
    done = folder / "summary.json"
    wanted = json.dumps([scene, settings, steps])
    note = folder / "settings.json"
    if not (done.exists() and note.exists() and note.read_text() == wanted):
        command = [str(program), "simulate", scene, "-o", str(folder), "--frames", str(frames),
                   "--colour", colour]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        if steps:
            command += ["--steps", str(steps)]
        ended = subprocess.run(command, capture_output=True, text=True)
        if ended.returncode:
            raise RuntimeError(f"{' '.join(command)}: {ended.stderr.strip()}")
        note.write_text(wanted)
    return json.loads(done.read_text())


def history(folder):
    """The columns of history.csv, as {name: [numbers]}."""
    with open(pathlib.Path(folder) / "history.csv") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def last_positions(folder):
    """Particle positions of the last written step, [(x, y, z)]."""
    newest = sorted(pathlib.Path(folder).glob("particles_*.vtp"))[-1]
    points = xml.etree.ElementTree.parse(newest).find(".//Points/DataArray").text.split()
    numbers = [float(x) for x in points]
    return list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))


def last_frame(folder):
    return sorted(pathlib.Path(folder).glob("frame_*.svg"))[-1]


def side_by_side(pictures, out, columns, width=520):
    """One SVG of [(title, file)], row by row."""
    size = re.search(r'viewBox="0 0 (\S+) (\S+)"', pathlib.Path(pictures[0][1]).read_text()[:400])
    height = width * float(size[2]) / float(size[1])
    rows = -(-len(pictures) // columns)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" '
             f'viewBox="0 0 {columns * width} {rows * (height + 28):.0f}" font-family="sans-serif">',
             '<rect width="100%" height="100%" fill="#ffffff"/>']
    for index, (title, file) in enumerate(pictures):
        x, y = index % columns * width, index // columns * (height + 28)
        ident = f"p{index}-"
        text = pathlib.Path(file).read_text()
        # Names of gradients are one document's: give each picture its own.
        text = re.sub(r'\bid="', f'id="{ident}', text).replace("url(#", f"url(#{ident}")
        text = text.replace("<svg ", f'<svg x="{x}" y="{y + 28:.0f}" width="{width}" '
                                     f'height="{height:.0f}" ', 1)
        parts.append(f'<text x="{x + 12}" y="{y + 22:.0f}" font-size="19" font-weight="bold" '
                     f'fill="#263238">{title}</text>')
        parts.append(text)
    parts.append("</svg>\n")
    pathlib.Path(out).write_text("\n".join(parts))


def plotting():
    """matplotlib that writes the same SVG for the same data."""
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams["svg.hashsalt"] = "conebench"
    return plt


def save(figure, path):
    figure.savefig(path, metadata={"Date": None}, bbox_inches="tight")
