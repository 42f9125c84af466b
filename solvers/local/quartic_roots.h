#pragma once

namespace conebench::solvers {

/// Real parts of those roots of  x^4 + c3 x^3 + c2 x^2 + c1 x + c0  whose imaginary part is at most
/// 1e-4 of their size, with multiplicity, in `roots`; their count. Ferrari's closed form: a double
/// root is good to the square root of rounding only, so polish.
int nearly_real_quartic_roots(double c3, double c2, double c1, double c0, double roots[4]);

}  // namespace conebench::solvers
