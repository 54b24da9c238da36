#pragma once

#include <cstddef>

namespace tbb {

/// Limits nothing: there is one thread (parallel_for.h).
struct global_control {
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t) {}
};

}  // namespace tbb
