#pragma once

namespace conebench::solvers {

/// Sets the threads of the BLAS (OpenBLAS) and of OpenMP in the libraries that we call, where they
/// are loaded. One unless asked: small dense blocks lose more to waking threads than they win, and
/// a timed task has one core. Takes effect once a process; later calls do nothing.
void pin_library_threads(int threads = 1);

}  // namespace conebench::solvers
