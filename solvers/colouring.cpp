#include "solvers/colouring.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace conebench::solvers {
namespace {

// Sets of colours, 64 to a word; as long as its largest member needs.
class ColourSet {
 public:
  void clear() { words_.clear(); }
  void insert(int colour) {
    const auto word = static_cast<std::size_t>(colour) / 64;
    if (word >= words_.size()) words_.resize(word + 1, 0);
    words_[word] |= std::uint64_t{1} << (colour % 64);
  }
  void insert(const ColourSet& other) {
    if (other.words_.size() > words_.size()) words_.resize(other.words_.size(), 0);
    for (std::size_t k = 0; k < other.words_.size(); ++k) words_[k] |= other.words_[k];
  }
  int first_missing() const {
    for (std::size_t k = 0; k < words_.size(); ++k) {
      const int ones = std::countr_one(words_[k]);
      if (ones < 64) return static_cast<int>(64 * k) + ones;
    }
    return static_cast<int>(64 * words_.size());
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace

Colouring::Colouring(const problems::Problem& problem, const DelassusCoupling& coupling) {
  std::vector<int> cone_of_row(static_cast<std::size_t>(problem.rows()), -1);
  for (int i = 0; i < problem.cone_count(); ++i) {
    cone_of_row[static_cast<std::size_t>(problem.start(i))] = i;
  }
  std::vector<int> colour(static_cast<std::size_t>(problem.cone_count()), -1);
  ColourSet taken;
  for (int i = 0; i < problem.cone_count(); ++i) {
    taken.clear();
    for (const BlockedDelassus::Entry& entry : coupling.blocks().entries(i)) {
      const int other = cone_of_row[static_cast<std::size_t>(entry.row)];
      if (other < i) taken.insert(colour[static_cast<std::size_t>(other)]);
    }
    colour[static_cast<std::size_t>(i)] = taken.first_missing();
  }
  arrange(colour);
}

std::vector<int> Colouring::colours_by_runs(int cones, const BlockedRows& rows) {
  const auto length = static_cast<std::size_t>(rows.run_length());
  std::vector<ColourSet> of_run(static_cast<std::size_t>(rows.scaled_dofs()) / length);
  std::vector<int> colour(static_cast<std::size_t>(cones));
  ColourSet taken;
  for (int i = 0; i < cones; ++i) {
    taken.clear();
    for (const int run : rows.runs(i)) taken.insert(of_run[static_cast<std::size_t>(run) / length]);
    const int mine = taken.first_missing();
    colour[static_cast<std::size_t>(i)] = mine;
    for (const int run : rows.runs(i)) of_run[static_cast<std::size_t>(run) / length].insert(mine);
  }
  return colour;
}

void Colouring::arrange(const std::vector<int>& colour) {
  if (colour.empty()) return;
  std::vector<std::vector<int>> cones(static_cast<std::size_t>(*std::ranges::max_element(colour)) +
                                      1);
  for (std::size_t i = 0; i < colour.size(); ++i) {
    cones[static_cast<std::size_t>(colour[i])].push_back(static_cast<int>(i));
  }
  for (std::vector<int>& same : cones) {
    if (same.size() >= kLeastParallel) {
      parallel_.push_back(std::move(same));
    } else {
      serial_.insert(serial_.end(), same.begin(), same.end());
    }
  }
}

}  // namespace conebench::solvers
