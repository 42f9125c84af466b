#!/usr/bin/env python3
"""Draws docs/pictures/sand.svg anew: moments of the MPM engine's scenes.

    sand_pictures.py [--program conebench] [--work DIR]
"""
import argparse
import pathlib

import common
import scene_runs

SCENES = (("sand-column", "dry column"), ("sand-column-cohesive", "cohesive column"),
          ("sand-silo", "silo"), ("sand-door", "behind a door"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=common.PROGRAM)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("sand-picture-runs"))
    args = parser.parse_args()
    pictures = []
    for scene, title in SCENES:
        folder = args.work / scene
        scene_runs.simulate(args.program, scene, folder, {}, frames=3, colour="speed")
        pictures.append((title, sorted(folder.glob("frame_*.svg"))[1]))
    out = pathlib.Path(__file__).resolve().parent.parent / "docs" / "pictures" / "sand.svg"
    scene_runs.side_by_side(pictures, out, 2)


if __name__ == "__main__":
    main()
