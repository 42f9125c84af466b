#!/usr/bin/env python3
"""Writes a problem file with h5py alone: one step of a tower of blocks, pushed sideways at its foot.

    write_problem.py FILE.h5

Debian's packages python3-h5py and python3-numpy are enough. docs/file-format.md says what may stand
in a file, docs/export-from-your-engine.md what is behind the numbers.
"""
import sys

import h5py
import numpy as np


def compressed_rows(entries, shape):
    """(row, column, value) triplets as data, indices, indptr: what scipy.sparse calls CSR."""
    rows, columns, values = (np.array(part) for part in zip(*entries))
    order = np.lexsort((columns, rows))
    indptr = np.concatenate([[0], np.cumsum(np.bincount(rows, minlength=shape[0]))])
    return values[order].astype(float), columns[order], indptr


def write_matrix(group, name, entries, shape):
    matrix = group.create_group(name)
    matrix["data"], matrix["indices"], matrix["indptr"] = compressed_rows(entries, shape)
    matrix.attrs["shape"] = shape
    matrix.attrs["format"] = "csr"


def write_problem(path, name, M, H, f, w, dims, mu, kappa, theta):
    """The primal form: M v = f + H^T r, u = H v + w. M and H are triplets, the others arrays."""
    with h5py.File(path, "w") as file:
        file.attrs["format"] = "conebench-problem"
        file.attrs["format_version"] = 1
        file.attrs["name"] = name
        file.attrs["engine"] = "write_problem.py"
        problem = file.create_group("problem")
        problem["dim"] = np.asarray(dims, dtype="int32")
        for key, values in (("mu", mu), ("kappa", kappa), ("theta", theta), ("f", f), ("w", w)):
            problem[key] = np.asarray(values, dtype=float)
        write_matrix(problem, "M", M, (len(f), len(f)))
        write_matrix(problem, "H", H, (len(w), len(f)))


def tower(blocks=5, mass_kg=2.0, step_s=1e-3, friction=0.5, push_N=60.0):
    """Two dimensions, blocks that do not turn: contact i is under block i, normal upwards."""
    M = [(k, k, mass_kg) for k in range(2 * blocks)]
    f = np.zeros(2 * blocks)
    f[1::2] = -step_s * mass_kg * 9.81  # weight; everything is at rest before the step
    f[0] = step_s * push_N
    H = []
    for i in range(blocks):
        normal, tangential = 2 * i, 2 * i + 1
        H += [(normal, 2 * i + 1, 1.0), (tangential, 2 * i, 1.0)]
        if i > 0:  # on the block below; the first stands on the ground
            H += [(normal, 2 * i - 1, -1.0), (tangential, 2 * i - 2, -1.0)]
    mu = np.full(blocks, friction)
    return {
        "M": M, "H": H, "f": f, "w": np.zeros(2 * blocks),
        "dims": np.full(blocks, 2), "mu": mu, "kappa": np.zeros(blocks), "theta": mu,
    }


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write_problem(sys.argv[1], "tower_000000", **tower())
