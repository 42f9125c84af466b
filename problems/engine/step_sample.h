#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "problems/engine/step_selection.h"

namespace conebench::engine {

/// What a step is judged by once it is solved.
struct StepFacts {
  std::int64_t step = 0;
  std::int64_t cones = 0;
  std::int64_t iterations = 0;  ///< of the step solver
  bool converged = true;
};

/// A step of the sample.
struct SampledStep {
  std::int64_t step = 0;
  double weight = 1.0;  ///< how many steps it stands for
};

/// A sample of at most K of the steps of a run, chosen while the run goes on. It depends on the
/// facts and the seed alone; no time enters.
///
/// Memory  proportional to K, however many steps are offered.
class StepSample {
 public:
  /// What becomes of a step: not kept, kept, or kept in the place of another.
  struct Verdict {
    bool keep = false;
    std::optional<std::int64_t> instead_of{};
  };

  virtual ~StepSample() = default;

  virtual Verdict offer(const StepFacts& facts) = 0;
  /// The sample of what was offered so far, in increasing order of steps.
  virtual std::vector<SampledStep> steps() const = 0;
};

/// The sample that the selection asks for; null for Sampling::kNone.
///
/// kHardest     steps that did not converge before those that did; among either, more iterations
///              before fewer, then more cones, then the earlier step. Each has weight 1: the
///              others are not represented.
/// kReservoir   every set of K steps is as likely as any other (Vitter, ACM TOMS 11(1), 1985,
///              Algorithm R; paper not checked, the argument is short). Weight n / K of n steps.
/// kStratified  one stratum for each pair of floor(log2 cones) and floor(log2 iterations) that
///              occurs, 0 iterations apart. Strata keep all their steps or, where that is too many,
///              equal numbers give or take one; within a stratum every set is as likely as any
///              other. The weight is steps of the stratum / steps kept of it: weights sum up to n.
///              A stratum beyond the K-th counts as the nearest of those there are.
std::unique_ptr<StepSample> make_sample(const StepSelection& selection, std::uint64_t seed);

}  // namespace conebench::engine
