#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace polynya::dynamics {

/// Makes parallel loops use a number of threads, also where there are fewer cores, for as long as it lives. A step's
/// loops last some ten microseconds each, as long as it takes to wake a thread: so the threads stay awake for some time
/// after each loop, where there is a core for each.
class ThreadLimit {
 public:
  using Work = std::function<void(std::size_t)>;

  /// Makes the threads. Throws std::bad_alloc where there is no room for them.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  /// Calls a function whose parallel loops are to use these threads.
  void execute(const std::function<void()>& function);

  /// That of the function which this thread executes; null: its loops are its own. So are those within a loop.
  static ThreadLimit* current();

  /// Calls work(chunk) for each chunk below `count`, on all threads. Rethrows what one throws. count < 2^20.
  void run(std::size_t count, const Work& work);

 private:
  void serve(bool from_front);
  bool run_one(bool from_front);
  void stop();

  // Chunks that none has taken: of the loop at hand, counted in the upper bits; then the first, and the one after the
  // last. One half of the threads takes them from the front and one from the back, so that each comes to the same
  // memory in each step.
  alignas(64) std::atomic<std::uint64_t> open_ = 0;
  alignas(64) std::atomic<std::size_t> unfinished_ = 0;
  alignas(64) const Work* work_ = nullptr;
  int patience_ = 0;  // how often a thread asks for a loop before it sleeps
  std::atomic_flag has_failed_;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;
};

}  // namespace polynya::dynamics
