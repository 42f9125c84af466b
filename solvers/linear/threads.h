#pragma once

namespace conebench::solvers {

/// One thread for the BLAS (OpenBLAS) and for OpenMP in the libraries that we call, where they are
/// loaded: small dense blocks lose more to waking threads than they win, and a timed task has one
/// core. Takes effect once a process; later calls do nothing.
void pin_library_threads();

}  // namespace conebench::solvers
