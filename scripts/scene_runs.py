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


def balls(count):
    """A cubic column of about `count` balls of 7 to 10 mm, its walls around it."""
    side = 0.02 * max(2, round(count ** (1 / 3)))
    half = f"{0.5 * side:g}"
    walls = {"planes[1].point_m[0]": f"-{half}", "planes[2].point_m[0]": half,
             "planes[3].point_m[1]": f"-{half}", "planes[4].point_m[1]": half}
    return walls | {"columns[0].width_m": f"{side:g}", "columns[0].height_m": f"{side:g}",
                    "beds[0].width_m": f"{2 * side:g}"}


def history(folder):
    """The columns of history.csv, as {name: [numbers]}."""
    with open(pathlib.Path(folder) / "history.csv") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def numbers_of(file, array):
    """An array of a ParaView file, as one list."""
    data = xml.etree.ElementTree.parse(file).find(f".//DataArray[@Name='{array}']")
    return [float(x) for x in data.text.split()]


def points_of(file):
    """The places of the points of a ParaView file, [(x, y, z)]."""
    numbers = numbers_of(file, "points")
    return list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))


def last_positions(folder):
    """Particle positions of the last written step, [(x, y, z)]."""
    return points_of(sorted(pathlib.Path(folder).glob("particles_*.vtp"))[-1])


def sphere_files(folder):
    """What the DEM engine wrote of its spheres, [(time, file)]."""
    folder = pathlib.Path(folder)
    sets = xml.etree.ElementTree.parse(folder / "spheres.pvd").iter("DataSet")
    return [(float(s.get("timestep")), folder / s.get("file")) for s in sets]


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
