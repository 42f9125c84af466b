#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace conebench::dem {

/// Copies of things, row by row and in each row in order of x, so that neighbours in a row are
/// neighbours in memory. Arrays are kept from use to use.
template <class Thing>
class RowOrder {
 public:
  /// Empty, with room for `things`.
  void restart(std::size_t things) {
    places_.clear();
    places_.reserve(things);
  }
  /// Thing `index` lies in `row` at x.
  void place(int row, int index, double x) { places_.push_back({x, row, index}); }

  /// Copies what has been placed; make(index) is the thing. Rows are 0 to `rows` - 1.
  template <class Make>
  void settle(std::size_t rows, Make make) {
    begin_.assign(rows + 2, 0);
    for (const Place& place : places_) ++begin_[at(place.row) + 2];
    for (std::size_t r = 2; r < begin_.size(); ++r) begin_[r] += begin_[r - 1];
    // Now begin_[r + 1] is where row r begins; filling moves it to where the row ends.
    sorted_.resize(places_.size());
    for (const Place& place : places_) sorted_[at(begin_[at(place.row) + 1]++)] = place;
    for (std::size_t r = 0; r < rows; ++r) {
      std::sort(sorted_.begin() + begin_[r], sorted_.begin() + begin_[r + 1],
                [](const Place& a, const Place& b) { return a.x < b.x; });
    }
    things_.clear();
    things_.reserve(places_.size());
    for (const Place& place : sorted_) things_.push_back(make(place.index));
  }

  std::span<const Thing> row(int r) const {
    const int begin = begin_[at(r)];
    return std::span(things_).subspan(at(begin), at(begin_[at(r) + 1] - begin));
  }

 private:
  struct Place {
    double x;
    int row, index;
  };
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  std::vector<Place> places_, sorted_;
  std::vector<int> begin_;
  std::vector<Thing> things_;
};

}  // namespace conebench::dem
