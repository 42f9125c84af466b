#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/paired_quantities.h"
#include "results/record.h"

namespace conebench::results {

/// The names of the quantities, in the order of a comparison:
///   sgm(time)                          shifted geometric mean, over the pairs that both solve
///   p50(time), p99(time), max(time)    order statistics over all pairs, a failure is infinite
///   gm(eta)                            geometric mean of eta, floored, over those that both solve
///   iterations                         geometric mean, over those that both solve
///   worst(iterations)                  the largest ratio of one pair that both solve: a mean over
///                                      many hides one solver that takes twice as many
///   solved                             pairs solved
///   failures                           pairs solved in BASE and not in NEW: a count, not a ratio
///   missing                            rows of BASE that NEW does not have: a count
std::vector<std::string> quantity_names();

/// Two sets of results on the tasks that both hold.
struct Comparison {
  std::size_t pairs = 0, scenes = 0;
  /// "SOLVER on PROBLEM, repetition 0", sorted: rows that the other side does not have.
  std::vector<std::string> only_base, only_fresh;
  /// Rows of one side that a later row of the same task replaces (another build, another host).
  std::size_t superseded = 0;
  bool other_host = false;                               ///< times come from different machines
  std::vector<std::string> new_failures, new_successes;  ///< named like the above
  std::vector<Quantity> quantities;
  /// Ratios of sgm(time) in [1 / noise, noise] are what two identical programs show: the larger of
  /// the A/A floors of both sides. Nothing unless tasks were repeated.
  std::optional<double> noise;

  const Quantity& quantity(const std::string& name) const;

  /// True where sgm(time) lies inside the noise floor.
  bool no_difference_measurable() const;

  /// What a gate sees: each quantity's value; sgm(time) is 1 inside the noise floor.
  std::map<std::string, std::optional<double>> gate_values() const;
};

/// Pairs rows by problem content, solver, donor, settings, repetition and place in a sequence;
/// neither by build nor by host, which are what is compared. Solved means: verified, in time.
/// Throws InputError when there is no pair at all.
Comparison compare(std::span<const Record> base, std::span<const Record> fresh);

}  // namespace conebench::results
