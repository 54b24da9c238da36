#include "io/run/memory_reserve.hpp"

#include <atomic>
#include <new>

namespace polynya::io {
namespace {

constexpr std::size_t kReserve = std::size_t{16} << 20;  ///< never touched, so it costs no pages [bytes]

std::atomic<char*> reserve = nullptr;
std::atomic<bool> is_used = false;

bool release() {
  char* const kept = reserve.exchange(nullptr);
  delete[] kept;
  return kept != nullptr;
}

void on_no_memory() {
  is_used = true;
  if (!release()) throw std::bad_alloc();
}

}  // namespace

void keep_memory_reserve() {
  if (reserve.load() != nullptr) return;
  is_used = false;
  reserve = new (std::nothrow) char[kReserve];
  std::set_new_handler(on_no_memory);
}

bool is_memory_reserve_used() {
  return is_used;
}

void release_memory_reserve() {
  release();
}

}  // namespace polynya::io
