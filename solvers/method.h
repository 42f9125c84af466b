#pragma once

#include "solvers/monitor.h"
#include "solvers/registry.h"

namespace conebench::solvers {

/// What a method's file provides: iterate from `guess` (rows() entries) until the monitor or the
/// method itself says stop. The wrapper has checked the request and made the monitor.
using Iterate = std::function<Result(const problems::Problem& standard, const Stop& stop,
                                     Eigen::VectorXd guess, Monitor& monitor)>;

/// Why a method refuses a problem, or nothing.
using Refuses = std::function<std::optional<std::string>(const problems::Problem&)>;

/// The refusal of methods that divide by the mobility: cones, but W = 0.
std::optional<std::string> refuse_zero_delassus(const problems::Problem& problem);

/// Wraps a method's iteration in what every solver owes its callers: the request is checked, the
/// guess completed, clock times filled in, the best iterate returned. With StopTest::kCommon the
/// best is the monitor's; with kOwn the method's last.
Solver make_checked_solver(const Method& method, const Values& values, Refuses refuses,
                           Iterate iterate);

}  // namespace conebench::solvers
