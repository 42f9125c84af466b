#pragma once

#include "solvers/method.h"

namespace conebench::solvers {

/// `gs-parallel`: Gauss-Seidel (solvers/gs.h) with the cones in colours that share no body or node,
/// each colour solved by several threads at once.
///
/// Nothing is random: the answer is the same bit for bit for any number of threads. It is not that
/// of `gs`, since the order of the cones is another one; the colours spread what a cone changes
/// less far in a sweep, so that it may need more of them.
///
/// Threads  `threads`, or with 0 those of the run (`--threads`), one unless it says otherwise.
/// Cost     a sweep of gs over the threads, one barrier a colour; once, the colours: a pass over
///          the blocks. Cones in colours of fewer than 64 are solved by one thread.
/// Source   colouring for parallel projected Gauss-Seidel is folklore; ours is first fit.
Method gauss_seidel_parallel();

}  // namespace conebench::solvers
