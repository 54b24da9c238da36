// Memory that runs out inside geometry is reported as that, never as a cut that failed.
#include <cstdlib>
#include <functional>
#include <new>
#include <string>

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/exact_memory.hpp"
#include "geometry/shape/outline.hpp"

namespace {

constexpr long kNever = -1;
long allocations_left = kNever;  ///< before one fails; the next ones do not

}  // namespace

// Of this executable: fails once, where a test wants it. Not inlined: gcc would see malloc() without free().
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#if defined(__SANITIZE_ADDRESS__)
// CGAL's half-built arrangements are leaked on purpose (geometry/cut/internal/arrangement.cpp).
extern "C" const char* __asan_default_options() {  // NOLINT: its name is the sanitizer's
  return "detect_leaks=0";
}
#endif

namespace polynya::geometry {
namespace {

/// Lets one allocation of some work fail, the first, the second, …, until none is left to fail. Each time it
/// throws std::bad_alloc or gives what it gives otherwise. Returns how often it threw.
int thrown_by(const std::function<std::string()>& work) {
  const std::string expected = work();
  int thrown = 0;
  for (long at = 0;; ++at) {
    std::string outcome = expected;
    allocations_left = at;
    try {
      outcome = work();
    } catch (const std::bad_alloc&) {
      ++thrown;
    }
    const bool has_failed = allocations_left < 0;
    allocations_left = kNever;
    EXPECT_EQ(outcome, expected) << "allocation " << at;
    if (!has_failed || testing::Test::HasFailure()) return thrown;
  }
}

std::string text_of(const CutOutcome& outcome) {
  if (!outcome) return std::string(name_of(outcome.error().reason)) + ": " + outcome.error().detail;
  std::string text;
  for (const Piece& piece : outcome->pieces) text += std::to_string(piece.shape.polygon.outer.size()) + ' ';
  return text;
}

const Shape kPlate{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
const Polygon kFrame{{{1, -1}, {8, -1}, {8, 7}, {1, 7}}, {{{2, 1}, {2, 5}, {6, 5}, {6, 1}}}};
const Polygon kBites{{{2, -1}, {4, -1}, {4, 2}, {2, 2}}, {}};

TEST(OutOfMemory, IsNoFailedCut) {
  EXPECT_GT(thrown_by([] { return text_of(cut_by_polygon(kPlate, kBites)); }), 10);
  EXPECT_GT(thrown_by([] { return text_of(cut_by_polygons(kPlate, {kFrame, kBites})); }), 10);
  EXPECT_GT(thrown_by([] { return text_of(cut_along(kPlate, {{5, -1}, {5.1, 11}})); }), 10);
  EXPECT_GT(thrown_by([] {
              return text_of(cut_along(kPlate, {{5, -1}, {5, 11}, {3, 11}, {6, 3}, {-1, 4}}));
            }),
            10);
}

TEST(OutOfMemory, IsNoFailedRepairOverlapOrTriangulation) {
  EXPECT_GT(thrown_by([] {
              const auto repaired = repair({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}, FillRule::kNonZero);
              return repaired ? std::to_string(repaired->shapes.size()) : repaired.error().detail;
            }),
            10);
  EXPECT_GT(thrown_by([] {
              const auto shared = overlap(kPlate, {}, {kBites}, {});
              return shared ? shared->exact_area : shared.error().detail;
            }),
            10);
  EXPECT_GT(thrown_by([] { return std::to_string(triangulate(kFrame).size()); }), 10);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these take all addresses

bool handler_was_called = false;

/// In a process of its own: takes all memory, and then computes.
[[noreturn]] void compute_without_memory() {
  let_exact_numbers_outlast_memory();
  std::set_new_handler([] {
    handler_was_called = true;
    throw std::bad_alloc();
  });
  const auto computed = [] {
    mpq_class sum = 0;
    for (int i = 1; i < 60; ++i) sum = sum * mpq_class(1.0 / 3) + mpq_class(1, i);
    return sum;
  };
  const mpq_class expected = computed();
  const rlimit limit{64U << 20, 64U << 20};
  setrlimit(RLIMIT_AS, &limit);
  for (std::size_t size = 1U << 20; size > 0; size /= 2) {
    while (void* taken = std::malloc(size)) *static_cast<volatile char*>(taken) = 1;
  }
  _exit(computed() == expected && handler_was_called ? 0 : 1);
}

TEST(OutOfMemory, ExactNumbersOutlastIt) {
  const pid_t child = fork();
  if (child == 0) compute_without_memory();
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

#endif

}  // namespace
}  // namespace polynya::geometry
