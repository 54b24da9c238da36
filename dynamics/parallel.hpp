#pragma once

#include <cstddef>
#include <functional>

namespace polynya::dynamics {

/// Calls work(0) to work(count − 1) in any order, on several threads at once, and returns after the last call. There
/// are two definitions, one of which a program links: parallel.cpp uses oneTBB, no_threads.cpp calls in order.
void run_parallel(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace polynya::dynamics
