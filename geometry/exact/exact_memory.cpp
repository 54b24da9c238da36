#include "geometry/exact/exact_memory.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <new>

#include <gmp.h>

namespace polynya::geometry {
namespace {

/// Numbers of a few hundred bytes, between two allocations of a cut that may throw. Costs no page until it is
/// used [bytes].
constexpr std::size_t kReserve = std::size_t{4} << 20;
alignas(std::max_align_t) char reserve[kReserve];
std::atomic<std::size_t> used = 0;  ///< of the reserve; what is freed there is not used again [bytes]

bool is_in_reserve(const void* memory) {
  const char* const place = static_cast<const char*>(memory);
  return std::greater_equal<>()(place, +reserve) && std::less<>()(place, reserve + kReserve);
}

/// GMP's own: ends the program, with a message, where there is no memory.
void* (*of_gmp)(std::size_t) = nullptr;

/// Reports that memory is out, as operator new does.
void call_new_handler() {
  try {
    if (const std::new_handler handler = std::get_new_handler()) handler();
  } catch (const std::bad_alloc&) {
  }  // not out of GMP
}

void* allocate_in_reserve(std::size_t size) {
  call_new_handler();
  constexpr std::size_t kUnit = alignof(std::max_align_t);
  const std::size_t rounded = (size + kUnit - 1) / kUnit * kUnit;
  const std::size_t first = used.fetch_add(rounded);
  if (rounded > kReserve || first > kReserve - rounded) return of_gmp(size);
  return reserve + first;
}

void* allocate(std::size_t size) {
  void* const memory = std::malloc(size);
  return memory ? memory : allocate_in_reserve(size);
}

void release(void* memory, std::size_t /*size*/) {
  if (!is_in_reserve(memory)) std::free(memory);
}

void* reallocate(void* memory, std::size_t size_before, std::size_t size) {
  if (!is_in_reserve(memory)) {
    if (void* const moved = std::realloc(memory, size)) return moved;
  }
  void* const moved = allocate(size);
  std::memcpy(moved, memory, std::min(size_before, size));
  release(memory, size_before);
  return moved;
}

}  // namespace

void let_exact_numbers_outlast_memory() {
  if (of_gmp != nullptr) return;
  mp_get_memory_functions(&of_gmp, nullptr, nullptr);
  mp_set_memory_functions(allocate, reallocate, release);
}

}  // namespace polynya::geometry
