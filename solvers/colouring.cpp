#include "solvers/colouring.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace conebench::solvers {

// The places that each cone touches: two cones clash where they share one.
struct Colouring::Footprints {
  std::vector<std::size_t> begin{0};  // of cone i in `place`
  std::vector<int> place{};
  std::size_t places = 0;

  std::span<const int> of(int cone) const {
    const auto i = static_cast<std::size_t>(cone);
    return std::span(place).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

namespace {

constexpr int kMostSlabs = 128;
constexpr std::size_t kLongestPiece = 256;
// What it costs to take a stretch, in cones solved meanwhile: its first cones meet bodies that
// another core has. Measured on spheres: with less, 5000 contacts get 5 colours in place of 2 and
// take a tenth longer.
constexpr int kStretch = 16;
// Share of Graham's bound that a colour's threads wait for the last of them. With twice as much,
// 4e4 contacts of spheres are cut into small pieces and take a tenth longer.
constexpr double kUneven = 0.25;
// Slabs that take so much longer than the work evenly divided are weighed against pieces.
constexpr double kWellDivided = 1.3;

struct Arrangement {
  std::vector<Stretches> parallel{};
  std::vector<int> left{};
  double cost = 0.0;  // cones solved in sequence, and what goes with them
};

template <class Footprints>
Stretches slabs(const std::vector<int>& cones, int count, const Footprints& footprints) {
  std::vector<int> owner(footprints.places, -1);
  Stretches all;
  std::vector<std::vector<int>> cuts(static_cast<std::size_t>(count));
  for (std::size_t s = 0; s < cuts.size(); ++s) {
    const auto mine = static_cast<int>(s);
    for (std::size_t k = s * cones.size() / cuts.size(); k < (s + 1) * cones.size() / cuts.size();
         ++k) {
      const auto touched = footprints.of(cones[k]);
      const bool inside = std::ranges::all_of(touched, [&](int place) {
        const int by = owner[static_cast<std::size_t>(place)];
        return by < 0 || by == mine;
      });
      (inside ? all.cones : cuts[s]).push_back(cones[k]);
      if (!inside) continue;
      for (const int place : touched) owner[static_cast<std::size_t>(place)] = mine;
    }
    all.close();
  }
  for (const std::vector<int>& cut : cuts) {
    all.cones.insert(all.cones.end(), cut.begin(), cut.end());
    all.close();
  }
  return all;
}

Stretches pieces(const std::vector<int>& cones, std::size_t length) {
  Stretches all{.cones = cones};
  for (std::size_t end = length; end < cones.size(); end += length) {
    all.begin.push_back(static_cast<int>(end));
  }
  all.begin.push_back(static_cast<int>(cones.size()));
  return all;
}

// Cones in sequence where `threads` take one stretch after another: their share, and some of what
// the longest stretch may add (Graham's bound), since nobody knows what each cone will cost. Memory
// is read in the order of the problem; to skip cones costs as much as two more.
double in_sequence(const Stretches& stretches, int threads) {
  int longest = 0, all = 0;
  for (int s = 0; s < stretches.count(); ++s) {
    const auto cones = stretches.stretch(s);
    int work = std::min(kStretch, static_cast<int>(cones.size())), next = -1;
    for (const int i : cones) {
      work += i == next ? 1 : 3;
      next = i + 1;
    }
    longest = std::max(longest, work);
    all += work;
  }
  return std::max(1.0 * all / threads + kUneven * longest * (1.0 - 1.0 / threads), 1.0 * longest);
}

// First fit; what finds none of 64 colours is left.
template <class Footprints>
Arrangement arranged(const Stretches& stretches, const Footprints& footprints) {
  std::vector<std::uint64_t> taken(footprints.places, 0);
  std::vector<Stretches> colours;
  Arrangement out;
  for (int s = 0; s < stretches.count(); ++s) {
    const auto cones = stretches.stretch(s);
    std::uint64_t known = 0;
    for (const int i : cones) {
      for (const int place : footprints.of(i)) known |= taken[static_cast<std::size_t>(place)];
    }
    const auto first = static_cast<std::size_t>(std::countr_one(known));
    if (first == 64) {
      out.left.insert(out.left.end(), cones.begin(), cones.end());
      continue;
    }
    for (const int i : cones) {
      for (const int place : footprints.of(i)) {
        taken[static_cast<std::size_t>(place)] |= std::uint64_t{1} << first;
      }
    }
    if (first >= colours.size()) colours.resize(first + 1);
    colours[first].cones.insert(colours[first].cones.end(), cones.begin(), cones.end());
    colours[first].close();
  }
  for (Stretches& colour : colours) {
    const double together = Colouring::kBarrier + in_sequence(colour, Colouring::kThreads);
    if (together < static_cast<double>(colour.cones.size())) {
      out.cost += together;
      out.parallel.push_back(std::move(colour));
    } else {
      out.left.insert(out.left.end(), colour.cones.begin(), colour.cones.end());
    }
  }
  out.cost += static_cast<double>(out.left.size());
  return out;
}

}  // namespace

void Colouring::arrange(const std::vector<int>& regular, const Footprints& footprints) {
  if (regular.empty()) return;
  const auto count = static_cast<double>(regular.size());
  Arrangement best{.left = regular, .cost = count};
  const auto consider = [&](const Stretches& stretches) {
    Arrangement next = arranged(stretches, footprints);
    if (next.cost < best.cost) best = std::move(next);
  };
  for (int s = kThreads; s <= kMostSlabs; s *= 2) consider(slabs(regular, s, footprints));
  if (best.cost > kWellDivided * count / kThreads) {
    for (std::size_t length = kLongestPiece; length > 0; length /= 2) {
      if (length < regular.size()) consider(pieces(regular, length));
    }
  }
  parallel_ = std::move(best.parallel);
  serial_.insert(serial_.end(), best.left.begin(), best.left.end());
}

Colouring::Colouring(const problems::Problem& problem, const DelassusCoupling& coupling) {
  const int cones = problem.cone_count();
  std::vector<int> cone_of_row(static_cast<std::size_t>(problem.rows()), -1);
  std::vector<int> regular;
  for (int i = 0; i < cones; ++i) {
    cone_of_row[static_cast<std::size_t>(problem.start(i))] = i;
    (coupling.blocks().entries(i).size() > kHub ? serial_ : regular).push_back(i);
  }
  // A place for each coupled pair, as W may hold a block on one side of its diagonal only.
  std::vector<std::pair<int, int>> touches;
  int pairs = 0;
  for (int i = 0; i < cones; ++i) {
    for (const BlockedDelassus::Entry& entry : coupling.blocks().entries(i)) {
      const int other = cone_of_row[static_cast<std::size_t>(entry.row)];
      if (other == i) continue;
      touches.emplace_back(i, pairs);
      touches.emplace_back(other, pairs);
      ++pairs;
    }
  }
  std::ranges::sort(touches);
  Footprints footprints{.places = static_cast<std::size_t>(pairs)};
  for (int i = 0; i < cones; ++i) {
    while (footprints.place.size() < touches.size() &&
           touches[footprints.place.size()].first == i) {
      footprints.place.push_back(touches[footprints.place.size()].second);
    }
    footprints.begin.push_back(footprints.place.size());
  }
  arrange(regular, footprints);
}

void Colouring::colour_by_runs(int cones, const BlockedRows& rows) {
  const int run_length = rows.run_length();
  Footprints footprints{.places = static_cast<std::size_t>(rows.scaled_dofs() / run_length)};
  std::vector<int> felt_by(footprints.places, 0);
  for (int i = 0; i < cones; ++i) {
    for (const int run : rows.runs(i)) {
      footprints.place.push_back(run / run_length);
      ++felt_by[static_cast<std::size_t>(run / run_length)];
    }
    footprints.begin.push_back(footprints.place.size());
  }
  std::vector<int> regular;
  for (int i = 0; i < cones; ++i) {
    const bool hub = std::ranges::any_of(footprints.of(i), [&](int place) {
      return felt_by[static_cast<std::size_t>(place)] > kHub;
    });
    (hub ? serial_ : regular).push_back(i);
  }
  arrange(regular, footprints);
}

}  // namespace conebench::solvers
