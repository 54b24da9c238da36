#include "dynamics/thread_limit.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace polynya::dynamics {

struct ThreadLimit::Arena {
  explicit Arena(int threads)
      : most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control most;
  tbb::task_arena arena;
};

ThreadLimit::ThreadLimit(int threads) : arena_(std::make_unique<Arena>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

void ThreadLimit::execute(const std::function<void()>& function) {
  arena_->arena.execute(function);
}

}  // namespace polynya::dynamics
