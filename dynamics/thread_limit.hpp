#pragma once

#include <functional>
#include <memory>

namespace polynya::dynamics {

/// Makes parallel loops use a number of threads, also where there are fewer cores, for as long as it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  /// Calls a function whose parallel loops are to use these threads.
  void execute(const std::function<void()>& function);

 private:
  std::shared_ptr<void> arena_;  ///< oneTBB's; null in a program without threads
};

}  // namespace polynya::dynamics
