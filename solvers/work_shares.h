#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace conebench::solvers {

/// Items 0 to count - 1 for several threads: each has a share of neighbours, takes from its front,
/// and when it is empty from the back of another's. So a thread meets nearly the same items time
/// after time, in its own cache, and none waits while another has more than it is at.
class WorkShares {
 public:
  explicit WorkShares(int threads) : shares_(static_cast<std::size_t>(threads)) {}

  /// Thread `thread` of `threads`, at most as many as shares, deals its own; then it takes until
  /// there is none. Between two rounds the threads must meet.
  void deal(int thread, int threads, int count) {
    const auto from = [&](std::int64_t t) {
      return static_cast<std::uint32_t>(count * t / threads);
    };
    share(thread).store(packed(from(thread), from(thread + 1)));
  }

  /// An item that nobody else gets, or -1 when all shares dealt so far are empty.
  int take(int thread) {
    const int threads = static_cast<int>(shares_.size());
    for (int k = 0; k < threads; ++k) {
      const int item = take_from((thread + k) % threads, k == 0);
      if (item >= 0) return item;
    }
    return -1;
  }

 private:
  using Share = std::atomic<std::uint64_t>;  // of one item to another: begin, then end
  struct alignas(64) Line {                  // no two in one line of the cache
    Share share{0};
  };

  static std::uint64_t packed(std::uint32_t begin, std::uint32_t end) {
    return std::uint64_t{begin} << 32 | end;
  }
  Share& share(int thread) { return shares_[static_cast<std::size_t>(thread)].share; }

  int take_from(int owner, bool front) {
    Share& taken = share(owner);
    std::uint64_t seen = taken.load();
    for (;;) {
      const auto begin = static_cast<std::uint32_t>(seen >> 32);
      const auto end = static_cast<std::uint32_t>(seen);
      if (begin >= end) return -1;
      const std::uint64_t left = front ? packed(begin + 1, end) : packed(begin, end - 1);
      if (taken.compare_exchange_weak(seen, left)) {
        return static_cast<int>(front ? begin : end - 1);
      }
    }
  }

  std::vector<Line> shares_;
};

}  // namespace conebench::solvers
