#!/usr/bin/env python3
"""my_solver: projected Gauss-Seidel in numpy, with a dense W.

    conebench solve FILE -s "exec:my_solver.py[omega=1.3]"

Find r with u = W r + q and, in every cone i, K_mu* containing u + theta |u_t| e_n, orthogonal to
r in K_mu. Component 0 of a cone is its normal. A sweep does, for each cone i in order,

    r_i <- P_K(r_i - (omega / lambda_i) (u_i + theta_i |u_it| e_n)),   lambda_i = |W_ii|.

Replace it by something better. docs/add-a-solver.md of conebench states the protocol.
"""
import argparse
import sys
import time

import h5py
import numpy as np


def dense(group):
    """A matrix stored by compressed rows."""
    matrix = np.zeros(group.attrs["shape"])
    data, indices, indptr = (group[name][()] for name in ("data", "indices", "indptr"))
    for row in range(len(indptr) - 1):
        for k in range(indptr[row], indptr[row + 1]):
            matrix[row, indices[k]] = data[k]
    return matrix


def delassus(problem):
    """W and q, given as they are or as H M^-1 H^T and H M^-1 f + w."""
    if "W" in problem:
        return dense(problem["W"]), problem["q"][()]
    M, H = dense(problem["M"]), dense(problem["H"])
    return H @ np.linalg.solve(M, H.T), H @ np.linalg.solve(M, problem["f"][()]) + problem["w"][()]


def project(x, mu):
    """The point of K_mu = {|x_t| <= mu x_n} nearest to x."""
    tangent = np.linalg.norm(x[1:])
    if x[0] >= 0 and tangent <= mu * x[0]:
        return x
    if mu * tangent <= -x[0]:
        return np.zeros_like(x)
    normal = (x[0] + mu * tangent) / (1 + mu * mu)
    return np.concatenate([[normal], mu * normal * x[1:] / tangent])


class Cones:
    def __init__(self, problem, W):
        """Rows, mu, theta and lambda (`size`) of every cone."""
        self.mu, self.theta = problem["mu"][()], problem["theta"][()]
        ends = np.cumsum(problem["dim"][()])
        self.rows = [slice(a, b) for a, b in zip(np.concatenate([[0], ends]), ends)]
        size = np.array([np.linalg.norm(W[at, at], 2) for at in self.rows])
        self.size = np.maximum(size, 1e-12 * size.max(initial=0.0))

    def stepped(self, i, r, u, omega):
        """Where one projection takes r_i, for a given u_i."""
        u_hat = u.copy()
        u_hat[0] += self.theta[i] * np.linalg.norm(u[1:])
        return project(r - omega * u_hat / self.size[i], self.mu[i])

    def eta(self, r, u, rate_scale):
        """The residual that the answer is judged by."""
        steps = [self.size[i] * np.linalg.norm(r[at] - self.stepped(i, r[at], u[at], 1.0))
                 for i, at in enumerate(self.rows)]
        return max(steps, default=0.0) / rate_scale


def solve(W, q, cones, rate_scale, r, omega, tol, deadline):
    """Returns r, the number of sweeps, and whether eta(r) <= tol."""
    sweeps = 0
    while True:
        if cones.eta(r, W @ r + q, rate_scale) <= tol:
            return r, sweeps, True
        if time.monotonic() > deadline:
            return r, sweeps, False
        for i, at in enumerate(cones.rows):
            r[at] = cones.stepped(i, r[at], W[at] @ r + q[at], omega)
        sweeps += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("problem")
    parser.add_argument("solution")
    parser.add_argument("--tol", type=float, required=True)
    parser.add_argument("--time-limit", type=float, required=True, help="seconds, or inf")
    parser.add_argument("--omega", type=float, default=1.0, help="relaxation of a step [-]")
    args = parser.parse_args()
    deadline = time.monotonic() + 0.8 * args.time_limit - 0.5  # time to start, and to write

    with h5py.File(args.problem) as file:
        W, q = delassus(file["problem"])
        cones = Cones(file["problem"], W)
        r, rate_scale = file["guess/r"][()], file.attrs["rate_scale"]
    r, sweeps, converged = solve(W, q, cones, rate_scale or 1.0, r, args.omega, args.tol, deadline)
    with h5py.File(args.solution, "w") as file:
        file["solution/r"] = r
        file["solution"].attrs["iterations"] = sweeps
    return 0 if converged else 1


if __name__ == "__main__":
    sys.exit(main())
