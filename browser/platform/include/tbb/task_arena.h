#pragma once

namespace tbb {

/// Calls on the one thread that there is (parallel_for.h).
struct task_arena {
  explicit task_arena(int) {}
  template <class Function>
  void execute(const Function& function) {
    function();
  }
};

}  // namespace tbb
