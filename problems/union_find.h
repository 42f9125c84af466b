#pragma once

#include <numeric>
#include <span>
#include <vector>

namespace conebench::problems {

/// Disjoint sets of 0..n-1 with path halving; near-linear in the number of calls.
class UnionFind {
 public:
  explicit UnionFind(int n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i) {
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  }

  /// The smaller root wins, so that labels do not depend on the order of calls.
  void join(int i, int j) {
    i = find(i);
    j = find(j);
    if (i < j) at(j) = i;
    if (j < i) at(i) = j;
  }

  /// Labels 0..count-1, numbered by each set's smallest member.
  std::vector<int> labels(int& count) {
    std::vector<int> label(parent_.size());
    count = 0;
    for (int i = 0; i < static_cast<int>(parent_.size()); ++i) {
      const int root = find(i);
      label[static_cast<std::size_t>(i)] =
          root == i ? count++ : label[static_cast<std::size_t>(root)];
    }
    return label;
  }

 private:
  int& at(int i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<int> parent_;
};

/// The members of each label 0..count-1, in increasing order, in one array.
class Groups {
 public:
  Groups(std::span<const int> labels, int count)
      : begin_(static_cast<std::size_t>(count) + 1, 0), members_(labels.size()) {
    for (const int label : labels) ++begin_[static_cast<std::size_t>(label) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      members_[next[static_cast<std::size_t>(labels[i])]++] = static_cast<int>(i);
    }
  }

  int count() const { return static_cast<int>(begin_.size()) - 1; }

  std::span<const int> operator[](int label) const {
    const std::size_t first = begin_[static_cast<std::size_t>(label)];
    const std::size_t last = begin_[static_cast<std::size_t>(label) + 1];
    return {members_.data() + first, last - first};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<int> members_;
};

}  // namespace conebench::problems
