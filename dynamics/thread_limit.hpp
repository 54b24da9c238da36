#pragma once

#include <functional>
#include <memory>

namespace polynya::dynamics {

/// Makes parallel loops use a given number of threads while it lives, even if there are fewer cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  /// Calls a function whose parallel loops use these threads.
  void execute(const std::function<void()>& function);

 private:
  std::shared_ptr<void> arena_;  ///< oneTBB's; null in a program without threads
};

}  // namespace polynya::dynamics
