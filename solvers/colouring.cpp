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

// At least so many stretches of a colour to share out, were there 8 colours.
constexpr std::size_t kLeastStretches = 256;

}  // namespace

template <class Colours>
void Colouring::cut(const std::vector<int>& regular, const Colours& colours) {
  if (regular.empty()) return;
  const std::vector<int> hubs = serial_;
  std::size_t length =
      std::clamp(regular.size() / kLeastStretches, std::size_t{1}, std::size_t{kLongest});
  while (true) {
    arrange(regular, length, colours(length));
    const auto left = static_cast<double>(serial_.size() - hubs.size());
    if (length == 1 || left <= kMostSerial * static_cast<double>(regular.size())) return;
    length /= 2;
    parallel_.clear();
    serial_ = hubs;
  }
}

void Colouring::arrange(const std::vector<int>& regular, std::size_t length,
                        const std::vector<int>& colour) {
  std::vector<Colour> all(static_cast<std::size_t>(*std::ranges::max_element(colour)) + 1);
  for (std::size_t s = 0; s < colour.size(); ++s) {
    Colour& mine = all[static_cast<std::size_t>(colour[s])];
    const auto first = regular.begin() + static_cast<std::ptrdiff_t>(s * length);
    const auto count = std::min(length, regular.size() - s * length);
    mine.cones.insert(mine.cones.end(), first, first + static_cast<std::ptrdiff_t>(count));
    mine.begin.push_back(static_cast<int>(mine.cones.size()));
  }
  for (Colour& mine : all) {
    if (mine.cones.size() >= kLeastParallel) {
      parallel_.push_back(std::move(mine));
    } else {
      serial_.insert(serial_.end(), mine.cones.begin(), mine.cones.end());
    }
  }
}

Colouring::Colouring(const problems::Problem& problem, const DelassusCoupling& coupling) {
  std::vector<int> cone_of_row(static_cast<std::size_t>(problem.rows()), -1);
  std::vector<int> regular;
  for (int i = 0; i < problem.cone_count(); ++i) {
    cone_of_row[static_cast<std::size_t>(problem.start(i))] = i;
    (coupling.blocks().entries(i).size() > kHub ? serial_ : regular).push_back(i);
  }
  std::vector<int> place(static_cast<std::size_t>(problem.cone_count()), -1);  // in regular
  for (std::size_t k = 0; k < regular.size(); ++k) {
    place[static_cast<std::size_t>(regular[k])] = static_cast<int>(k);
  }
  cut(regular, [&](std::size_t length) {
    std::vector<int> colour;
    ColourSet taken;
    for (std::size_t k = 0; k < regular.size(); ++k) {
      if (k % length == 0) taken.clear();
      for (const BlockedDelassus::Entry& entry : coupling.blocks().entries(regular[k])) {
        const int other = cone_of_row[static_cast<std::size_t>(entry.row)];
        const int at = place[static_cast<std::size_t>(other)];
        if (at < 0) continue;
        const std::size_t stretch = static_cast<std::size_t>(at) / length;
        if (stretch < colour.size()) taken.insert(colour[stretch]);
      }
      if (k % length == length - 1 || k + 1 == regular.size()) {
        colour.push_back(taken.first_missing());
      }
    }
    return colour;
  });
}

void Colouring::colour_by_runs(int cones, const BlockedRows& rows) {
  const auto run_length = static_cast<std::size_t>(rows.run_length());
  const std::size_t runs = static_cast<std::size_t>(rows.scaled_dofs()) / run_length;
  auto of = [&](int run) { return static_cast<std::size_t>(run) / run_length; };
  std::vector<int> felt_by(runs, 0);
  for (int i = 0; i < cones; ++i) {
    for (const int run : rows.runs(i)) ++felt_by[of(run)];
  }
  std::vector<int> regular;
  for (int i = 0; i < cones; ++i) {
    const bool hub =
        std::ranges::any_of(rows.runs(i), [&](int run) { return felt_by[of(run)] > kHub; });
    (hub ? serial_ : regular).push_back(i);
  }
  cut(regular, [&](std::size_t length) {
    std::vector<ColourSet> of_run(runs);
    std::vector<int> colour;
    ColourSet taken;
    for (std::size_t k = 0; k < regular.size(); k += length) {
      const auto stretch = std::span(regular).subspan(k, std::min(length, regular.size() - k));
      taken.clear();
      for (const int i : stretch) {
        for (const int run : rows.runs(i)) taken.insert(of_run[of(run)]);
      }
      const int mine = taken.first_missing();
      for (const int i : stretch) {
        for (const int run : rows.runs(i)) of_run[of(run)].insert(mine);
      }
      colour.push_back(mine);
    }
    return colour;
  });
}

}  // namespace conebench::solvers
