#pragma once

#include <functional>
#include <memory>

namespace polynya::dynamics {

/// Makes parallel loops use a given number of threads while it lives, even if there are fewer cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  /// Calls a function whose parallel loops use these threads.
  void execute(const std::function<void()>& function);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace polynya::dynamics
