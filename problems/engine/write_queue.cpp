#include "problems/engine/write_queue.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <utility>

namespace conebench::engine {
namespace {

using Clock = std::chrono::steady_clock;

// None arrives here, nor in threads that start, while it lives.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

WriteQueue::WriteQueue(Limits limits) : limits_(limits) {
  const SignalsBlocked blocked;  // in the new thread for good: a signal would interrupt its syncs
  thread_ = std::thread([this] { serve(); });
}

WriteQueue::~WriteQueue() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool WriteQueue::has_room_for(std::size_t bytes) const {
  const std::size_t jobs = jobs_.size() + (busy_ ? 1 : 0);
  return jobs == 0 || (jobs < limits_.jobs && bytes_ + bytes <= limits_.bytes);
}

void WriteQueue::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

std::int64_t WriteQueue::push(std::function<void()> work, std::size_t bytes) {
  std::unique_lock lock(mutex_);
  if (!has_room_for(bytes)) {
    const auto start = Clock::now();
    changed_.wait(lock, [&] { return has_room_for(bytes); });
    ++waits_;
    waited_s_ += std::chrono::duration<double>(Clock::now() - start).count();
  }
  rethrow();
  jobs_.push_back({std::move(work), bytes, pushed_});
  bytes_ += bytes;
  changed_.notify_all();
  return pushed_++;
}

bool WriteQueue::cancel(std::int64_t number) {
  const std::lock_guard lock(mutex_);
  const auto job = std::ranges::find(jobs_, number, &Job::number);
  if (job == jobs_.end()) return false;
  bytes_ -= job->bytes;
  jobs_.erase(job);
  return true;
}

void WriteQueue::check() {
  const std::lock_guard lock(mutex_);
  rethrow();
}

void WriteQueue::drain() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.empty() && !busy_; });
  rethrow();
}

void WriteQueue::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closed_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    busy_ = true;
    const bool skip = failure_ != nullptr;
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (!skip) job.work();
    } catch (...) {
      failure = std::current_exception();
    }
    job.work = nullptr;  // what it kept is given back before its place is
    lock.lock();
    if (failure) failure_ = failure;
    bytes_ -= job.bytes;
    busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace conebench::engine
