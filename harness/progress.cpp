#include "harness/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "results/text.h"

namespace conebench::harness {
namespace {

constexpr int kBarWidth = 24;
constexpr double kRedraw_s = 0.2, kLine_s = 30.0;

}  // namespace

bool stderr_takes_colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return ::isatty(STDERR_FILENO) == 1 && (no_color == nullptr || *no_color == '\0');
}

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      shown_(start_) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

double Progress::seconds_since(std::chrono::steady_clock::time_point when) const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - when).count();
}

void Progress::finished_one(bool solved) {
  ++done_;
  if (!solved) ++unsolved_;
}

std::string Progress::text() const {
  std::string line = fmt::format("{} {}/{}, {} not solved", label_, done_, total_, unsolved_);
  if (done_ > 0 && done_ < total_) {
    const double left_s =
        seconds_since(start_) * static_cast<double>(total_ - done_) / static_cast<double>(done_);
    line += fmt::format(", about {} left", results::format_time(left_s));
  }
  return line;
}

void Progress::show() {
  if (seconds_since(shown_) < (terminal_ ? kRedraw_s : kLine_s)) return;
  shown_ = std::chrono::steady_clock::now();
  if (!terminal_) {
    fmt::print(stderr, "{}\n", text());
    return;
  }
  const auto filled = total_ == 0 ? 0 : static_cast<int>(kBarWidth * done_ / total_);
  const std::string bar = fmt::format("{:#<{}}{:.<{}}", "", filled, "", kBarWidth - filled);
  if (stderr_takes_colour()) {
    fmt::print(stderr, "\r\x1b[K\x1b[36m[{}]\x1b[0m {}", bar, text());
  } else {
    fmt::print(stderr, "\r\x1b[K[{}] {}", bar, text());
  }
  std::fflush(stderr);
}

}  // namespace conebench::harness
