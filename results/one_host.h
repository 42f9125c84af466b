#pragma once

#include <map>
#include <span>
#include <string>

#include "results/record.h"

namespace conebench::results {

/// Which machine counts for a problem (or sequence) that was solved on several, as when a shard was
/// requeued on a node of another class: times of two machines are neither compared nor taken for
/// repetitions. Under each settings that class of hosts counts on which the most solvers were run,
/// of equal ones the one that began a task last.
class OneHost {
 public:
  /// Cost: nothing to speak of where all records come from one class of hosts.
  explicit OneHost(std::span<const Record> records);

  bool counts(const Record& record) const;

  /// Of the records, those that do not count.
  std::size_t left_out() const { return left_out_; }

 private:
  std::map<std::string, std::string> class_of_;  // by problem or sequence, and settings
  std::size_t left_out_ = 0;
};

}  // namespace conebench::results
