#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace conebench::engine {

/// Work that one thread of its own does in the order given, so that whoever hands it over goes on
/// at once; only when the queue is full does that one wait, and it is counted. The thread takes no
/// signals. To be used by one thread.
///
/// Errors: the first exception of the work comes out of push(), check() and drain(), from then on
/// each time; later work is thrown away.
class WriteQueue {
 public:
  /// Of the work that waits or is being done. Work of more bytes than that waits for an empty
  /// queue.
  struct Limits {
    std::size_t jobs = 64;
    std::size_t bytes = std::size_t{256} << 20;
  };

  explicit WriteQueue(Limits limits);
  ~WriteQueue();  ///< does what is left to do
  WriteQueue(const WriteQueue&) = delete;
  WriteQueue& operator=(const WriteQueue&) = delete;

  /// `bytes`: memory that the work keeps. Returns a number for cancel().
  std::int64_t push(std::function<void()> work, std::size_t bytes);
  /// Takes back what has not been begun; false for the rest.
  bool cancel(std::int64_t number);
  void check();
  /// Returns when all is done.
  void drain();

  std::int64_t waits() const { return waits_; }  ///< times that push() found the queue full
  double waited_s() const { return waited_s_; }  ///< by push()

 private:
  struct Job {
    std::function<void()> work;
    std::size_t bytes;
    std::int64_t number;
  };

  bool has_room_for(std::size_t bytes) const;
  void rethrow() const;
  void serve();

  Limits limits_;
  std::int64_t waits_ = 0;
  double waited_s_ = 0.0;

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<Job> jobs_;   // waiting
  bool busy_ = false;      // with one that is no longer among them
  std::size_t bytes_ = 0;  // of these and of that one
  std::int64_t pushed_ = 0;
  std::exception_ptr failure_;
  bool closed_ = false;
  std::thread thread_;
};

}  // namespace conebench::engine
