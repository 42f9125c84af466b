#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace conebench::harness {

/// Progress on stderr: a bar that is redrawn on a terminal, a line every 30 s elsewhere.
class Progress {
 public:
  Progress(std::string label, std::size_t total);
  ~Progress();  ///< leaves the terminal's line empty
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void finished_one(bool solved);
  void show();

 private:
  std::string text() const;
  double seconds_since(std::chrono::steady_clock::time_point when) const;

  std::string label_;
  std::size_t total_, done_ = 0, unsolved_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, shown_;
};

/// True when colours and redrawing are welcome on stderr: a terminal, and NO_COLOR is not set.
bool stderr_takes_colour();

}  // namespace conebench::harness
