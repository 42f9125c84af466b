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

// At least so many stretches in all, to begin with.
constexpr std::size_t kFirstStretches = 256;

struct Arrangement {
  std::vector<Colouring::Colour> parallel;
  std::vector<int> left;
};

Arrangement arranged(const std::vector<int>& cones, std::size_t length,
                     const std::vector<int>& colour) {
  std::vector<Colouring::Colour> all(static_cast<std::size_t>(*std::ranges::max_element(colour)) +
                                     1);
  for (std::size_t s = 0; s < colour.size(); ++s) {
    Colouring::Colour& mine = all[static_cast<std::size_t>(colour[s])];
    const auto first = cones.begin() + static_cast<std::ptrdiff_t>(s * length);
    const auto count = std::min(length, cones.size() - s * length);
    mine.cones.insert(mine.cones.end(), first, first + static_cast<std::ptrdiff_t>(count));
    mine.begin.push_back(static_cast<int>(mine.cones.size()));
  }
  Arrangement out;
  for (Colouring::Colour& mine : all) {
    if (mine.cones.size() >= Colouring::kLeastParallel &&
        mine.stretches() >= Colouring::kLeastStretches) {
      out.parallel.push_back(std::move(mine));
    } else {
      out.left.insert(out.left.end(), mine.cones.begin(), mine.cones.end());
    }
  }
  return out;
}

}  // namespace

template <class Colours>
void Colouring::cut(const std::vector<int>& regular, const Colours& colours) {
  if (regular.empty()) return;
  std::size_t length =
      std::clamp(regular.size() / kFirstStretches, std::size_t{1}, std::size_t{kLongest});
  Arrangement best = arranged(regular, length, colours(length));
  const auto enough = kMostSerial * static_cast<double>(regular.size());
  while (length > 1 && static_cast<double>(best.left.size()) > enough) {
    length /= 2;
    Arrangement next = arranged(regular, length, colours(length));
    if (next.left.size() < best.left.size()) best = std::move(next);
  }
  parallel_ = std::move(best.parallel);
  serial_.insert(serial_.end(), best.left.begin(), best.left.end());
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
    std::vector<ColourSet> taken((regular.size() + length - 1) / length);  // of each stretch
    for (std::size_t k = 0; k < regular.size(); k += length) {
      const auto stretch = std::span(regular).subspan(k, std::min(length, regular.size() - k));
      // function(stretch) of each stretch that W couples this one to.
      const auto for_coupled = [&](const auto& function) {
        for (const int i : stretch) {
          for (const BlockedDelassus::Entry& entry : coupling.blocks().entries(i)) {
            const int other = cone_of_row[static_cast<std::size_t>(entry.row)];
            const int at = place[static_cast<std::size_t>(other)];
            if (at >= 0) function(static_cast<std::size_t>(at) / length);
          }
        }
      };
      ColourSet& mine = taken[k / length];
      for_coupled([&](std::size_t s) {
        if (s < colour.size()) mine.insert(colour[s]);
      });
      colour.push_back(mine.first_missing());
      // W may hold a block on one side of its diagonal only.
      for_coupled([&](std::size_t s) {
        if (s >= colour.size()) taken[s].insert(colour.back());
      });
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
