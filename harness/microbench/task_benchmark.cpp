// What a task costs beyond its solve, beside the floors under it.
//
//   build/task_benchmark
//
// A task is a Child (two processes: supervisor and worker) and a line of the journal. The floors:
// fork and wait, once and twice; write and sync of as many bytes. A fork copies the page tables of
// its parent, hence the megabytes that the parent has touched as argument.

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/child.h"
#include "harness/host.h"
#include "results/journal.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;

// So many megabytes of this process's own, given back to the system with this object.
class Touched {
 public:
  explicit Touched(const benchmark::State& state)
      : bytes_(std::max<std::size_t>(1, static_cast<std::size_t>(state.range(0)) << 20)),
        memory_(
            ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    std::memset(memory_, 'x', bytes_);
  }
  ~Touched() { ::munmap(memory_, bytes_); }
  Touched(const Touched&) = delete;
  Touched& operator=(const Touched&) = delete;

 private:
  std::size_t bytes_;
  void* memory_;
};

void fork_and_wait(int generations) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (generations > 1) fork_and_wait(generations - 1);
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
}

void fork_floor(benchmark::State& state) {
  const Touched memory(state);
  for (auto _ : state) fork_and_wait(1);
}

void two_forks_floor(benchmark::State& state) {
  const Touched memory(state);
  for (auto _ : state) fork_and_wait(2);
}

void empty_task(benchmark::State& state) {
  const Touched memory(state);
  for (auto _ : state) {
    Child child([] { return std::string("done"); }, {});
    while (!child.poll()) wait_for_news({&child}, 1.0);
  }
}

results::Record typical_record() {
  results::Record record;
  record.problem = {.name = "column-dry_000420",
                    .content_sha256 = std::string(64, '0'),
                    .path = "problems/column-dry_000420.h5",
                    .family = "dem/column-dry",
                    .cones = 1234};
  record.solver = "gs[local=exact,omega=1.2]";
  record.host = current_host();
  for (int i = 0; i < 50; ++i) record.curve.push_back({1e-3 * i, i, std::exp(-0.3 * i)});
  return record;
}

// A folder for as long as this lives.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("conebench-bench-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void journal_append(benchmark::State& state) {
  const Folder folder;
  const results::Record record = typical_record();
  results::Journal journal(results::journal_path(folder.path()));
  for (auto _ : state) journal.append(record);
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(to_json(record).dump().size()));
}

void write_floor(benchmark::State& state) {
  const Folder folder;
  const std::string line = to_json(typical_record()).dump() + "\n";
  const int file = ::open((folder.path() / "lines").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  for (auto _ : state) {
    if (::write(file, line.data(), line.size()) < 0) state.SkipWithError("cannot write");
  }
  ::close(file);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(line.size()));
}

void write_and_sync_floor(benchmark::State& state) {
  const Folder folder;
  const std::string line = to_json(typical_record()).dump() + "\n";
  const int file = ::open((folder.path() / "lines").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  for (auto _ : state) {
    if (::write(file, line.data(), line.size()) < 0) state.SkipWithError("cannot write");
    ::fdatasync(file);
  }
  ::close(file);
}

constexpr std::int64_t kSomeMegabytes = 16, kManyMegabytes = 256;

BENCHMARK(fork_floor)->Arg(0)->Arg(kSomeMegabytes)->Arg(kManyMegabytes)->UseRealTime();
BENCHMARK(two_forks_floor)->Arg(0)->Arg(kSomeMegabytes)->Arg(kManyMegabytes)->UseRealTime();
BENCHMARK(empty_task)->Arg(0)->Arg(kSomeMegabytes)->Arg(kManyMegabytes)->UseRealTime();
BENCHMARK(write_floor)->UseRealTime();
BENCHMARK(write_and_sync_floor)->UseRealTime();
BENCHMARK(journal_append)->UseRealTime();

}  // namespace
}  // namespace conebench::harness

BENCHMARK_MAIN();
