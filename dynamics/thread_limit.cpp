#include "dynamics/thread_limit.hpp"

#include <new>
#include <system_error>
#include <utility>

namespace polynya::dynamics {
namespace {

/// How often a thread asks for a loop before it sleeps: for some 200 µs, longer than most serial parts of a step.
constexpr int kPatience = 10'000;
/// And for the end of one before others may have its core: where there are more threads than cores.
constexpr int kShortPatience = 1000;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

constexpr int kBits = 20;  // of a chunk's number
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

constexpr std::uint64_t loop_of(std::uint64_t open) {
  return open >> (2 * kBits);
}
constexpr std::uint64_t chunks(std::uint64_t loop, std::uint64_t begin, std::uint64_t end) {
  return loop << (2 * kBits) | begin << kBits | end;
}
constexpr std::uint64_t kOver = chunks(0, 1, 0);  // no more loops

thread_local ThreadLimit* executing = nullptr;

}  // namespace

ThreadLimit::ThreadLimit(int threads) {
  if (static_cast<unsigned>(threads) <= std::thread::hardware_concurrency()) patience_ = kPatience;
  try {
    for (int i = 1; i < threads; ++i) threads_.emplace_back([this, i] { serve(i % 2 == 0); });
  } catch (const std::system_error&) {
    stop();
    throw std::bad_alloc();
  } catch (...) {
    stop();
    throw;
  }
}

ThreadLimit::~ThreadLimit() {
  stop();
}

void ThreadLimit::stop() {
  open_.store(kOver);
  open_.notify_all();
  threads_.clear();
}

void ThreadLimit::execute(const std::function<void()>& function) {
  ThreadLimit* const before = std::exchange(executing, this);
  try {
    function();
  } catch (...) {
    executing = before;
    throw;
  }
  executing = before;
}

ThreadLimit* ThreadLimit::current() {
  return executing;
}

/// Takes a chunk and runs it. Returns false where none is left.
bool ThreadLimit::run_one(bool from_front) {
  std::uint64_t open = open_.load(std::memory_order_acquire);
  std::uint64_t begin = 0, end = 0;
  do {
    begin = open >> kBits & kMask;
    end = open & kMask;
    if (begin >= end) return false;
  } while (!open_.compare_exchange_weak(open,
                                        chunks(loop_of(open), begin + (from_front ? 1 : 0), end - (from_front ? 0 : 1)),
                                        std::memory_order_acquire));
  try {
    (*work_)(from_front ? begin : end - 1);
  } catch (...) {
    if (!has_failed_.test_and_set()) failure_ = std::current_exception();
  }
  unfinished_.fetch_sub(1, std::memory_order_release);
  return true;
}

void ThreadLimit::serve(bool from_front) {
  int waited = 0;
  for (std::uint64_t seen = 0;;) {
    while (run_one(from_front)) continue;
    const std::uint64_t open = open_.load(std::memory_order_acquire);
    if (open == kOver) return;
    if (open != seen)
      seen = open, waited = 0;
    else if (waited++ < patience_)
      pause();
    else
      open_.wait(seen, std::memory_order_acquire);
  }
}

void ThreadLimit::run(std::size_t count, const Work& work) {
  work_ = &work;
  unfinished_.store(count, std::memory_order_relaxed);
  open_.store(chunks(loop_of(open_.load(std::memory_order_relaxed)) + 1, 0, count), std::memory_order_seq_cst);
  open_.notify_all();
  ThreadLimit* const own = std::exchange(executing, nullptr);
  while (run_one(true)) continue;
  for (int waited = 0; unfinished_.load(std::memory_order_acquire) > 0; ++waited)
    waited < kShortPatience ? pause() : std::this_thread::yield();
  executing = own;
  if (!has_failed_.test()) return;
  has_failed_.clear();
  std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace polynya::dynamics
