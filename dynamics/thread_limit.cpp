#include "dynamics/thread_limit.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace polynya::dynamics {
namespace {

struct Arena {
  explicit Arena(int threads)
      : most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control most;
  tbb::task_arena arena;
};

}  // namespace

ThreadLimit::ThreadLimit(int threads) : arena_(std::make_shared<Arena>(threads)) {}

void ThreadLimit::execute(const std::function<void()>& function) {
  static_cast<Arena*>(arena_.get())->arena.execute(function);
}

}  // namespace polynya::dynamics
