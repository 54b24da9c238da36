#include "dynamics/thread_limit.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <latch>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {
namespace {

/// What a worker of TBB takes when it starts, and more, beside its stack [bytes].
constexpr std::size_t kRoomOfThread = std::size_t{1} << 20;

/// TBB aborts the program where a worker cannot be made (pthread_create), most often for want of memory for
/// its stack, or where there is none left for what the worker itself takes. So as many threads are made once
/// beforehand, all at the same time and with that much memory each, where that is an exception.
void require_threads(int count) {
  std::atomic<bool> has_room = true;
  std::latch all_ready(count), all_made(1);
  std::vector<std::jthread> threads;  // joined before the latches go
  try {
    for (int i = 0; i < count; ++i) {
      threads.emplace_back([&] {
        const std::unique_ptr<volatile char[]> room(new (std::nothrow) volatile char[kRoomOfThread]);
        if (room) room[0] = 1;  // so that it is really taken
        if (!room) has_room = false;
        all_ready.count_down();
        all_made.wait();
      });
    }
  } catch (const std::exception&) {  // std::system_error of a thread, std::bad_alloc of what it is kept in
    all_made.count_down();
    throw std::bad_alloc();
  }
  all_ready.wait();
  all_made.count_down();
  if (!has_room) throw std::bad_alloc();
}

/// Has TBB make its workers now, while there is room for them: each of the tasks waits for the others.
void start_workers(int threads) {
  constexpr auto kPatience = std::chrono::seconds(10);  ///< a busy machine may take longer
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  std::atomic<int> started = 0;
  for_chunks(static_cast<std::size_t>(threads), 1, threads, [&](std::size_t, std::size_t, std::size_t) {
    ++started;
    while (started < threads && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  });
}

}  // namespace

struct ThreadLimit::Arena {
  explicit Arena(int threads)
      : most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control most;
  tbb::task_arena arena;
};

ThreadLimit::ThreadLimit(int threads) {
  require_threads(threads - 1);
  arena_ = std::make_unique<Arena>(threads);
  arena_->arena.execute([threads] { start_workers(threads); });
}
ThreadLimit::~ThreadLimit() = default;

void ThreadLimit::execute(const std::function<void()>& function) {
  arena_->arena.execute(function);
}

}  // namespace polynya::dynamics
