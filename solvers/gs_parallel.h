#pragma once

#include "solvers/method.h"

namespace conebench::solvers {

/// `gs-parallel`: Gauss-Seidel (solvers/gs.h) in stretches of cones, and these in colours that
/// share no body or node (solvers/colouring.h); each colour is solved by several threads at once.
///
/// Nothing is random: the answer is the same bit for bit for any number of threads. It is not that
/// of `gs`, since the order of the cones is another one.
///
/// Threads  `threads`, or with 0 those of the run (`--threads`), one unless it says otherwise.
/// Cost     a sweep of gs over the threads, one barrier a colour; once, the colours: some passes
///          over the blocks. Cones of a body with more than 64, and small colours, are solved by
///          one thread.
/// Source   colouring for parallel projected Gauss-Seidel is folklore; ours is first fit.
Method gauss_seidel_parallel();

}  // namespace conebench::solvers
