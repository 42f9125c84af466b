#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/bootstrap.h"
#include "results/group.h"
#include "results/profiles.h"
#include "results/told_apart.h"

namespace conebench::results {

/// What the parts of a report ask of a group's methods at its own tolerance, computed once. Keeps a
/// reference to the group, which must have methods.
class GroupNumbers {
 public:
  /// Cost: compare_pairs().
  explicit GroupNumbers(const Group& group);

  const Group& group() const { return group_; }
  double tol() const { return group_.settings.tol; }
  const TimeTable& table() const { return table_; }  ///< every row
  const TimeTable& shown() const { return shown_; }  ///< comparable() rows
  const std::vector<Rank>& ranking() const { return ranking_; }
  const std::vector<SolverPair>& pairs() const { return pairs_; }
  std::size_t scenes() const { return scenes_; }

  /// The index of a contender in table().solvers.
  std::size_t place(const std::string& solver) const;

  /// Two solvers, the first over the second, whichever way round they were compared.
  SolverPair pair(const std::string& first, const std::string& second) const;

  /// Those that no order of `solver` and them is claimed for, best first.
  std::vector<std::string> not_told_apart_from(const std::string& solver) const;

  /// Those that the first of the ranking is not shown to be better than, best first: it is when it
  /// is told apart by the share solved, as the one that solves more, or else by time, as the
  /// faster.
  std::vector<std::string> not_beaten_by_best() const;

  /// 95 % interval of the share of problems solved; nothing with too few scenes.
  std::optional<Interval> share_interval(const std::string& solver) const;

 private:
  const Group& group_;
  TimeTable table_, shown_;
  std::vector<Rank> ranking_;
  std::vector<SolverPair> pairs_;
  std::size_t scenes_ = 0;
};

}  // namespace conebench::results
