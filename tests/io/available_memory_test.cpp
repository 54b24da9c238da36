#include "io/run/available_memory.hpp"

#include <cmath>

#include "temporary_folder.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

using io::memory_available;
using io::MemoryAvailable;

TEST(MemoryAvailable, IsWhatTheMachineHasFreeWithSwapAndWhatThisProcessHas) {
  const TemporaryFolder root;
  write_file(root / "proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    3000 kB\nSwapFree: 1000 kB\n");
  write_file(root / "proc/self/statm", "100 0 0 0 0 0 0\n");
  EXPECT_EQ(memory_available(root.path()).bytes, 4000 * 1024);
  write_file(root / "proc/self/statm", "100 10 0 0 0 0 0\n");
  EXPECT_GT(memory_available(root.path()).bytes, 4000 * 1024);
}

TEST(MemoryAvailable, IsTheLeastThatAControlGroupLeaves) {
  const TemporaryFolder root;
  write_file(root / "proc/meminfo", "MemAvailable:    30000 kB\n");
  write_file(root / "proc/self/cgroup", "0::/jobs/mine\n");
  write_file(root / "sys/fs/cgroup/jobs/mine/memory.max", "max\n");
  write_file(root / "sys/fs/cgroup/jobs/mine/memory.current", "50\n");
  write_file(root / "sys/fs/cgroup/jobs/memory.max", "5000000\n");
  write_file(root / "sys/fs/cgroup/jobs/memory.current", "4000000\n");
  write_file(root / "sys/fs/cgroup/jobs/memory.stat", "anon 1000000\nfile 2500000\n");
  const MemoryAvailable available = memory_available(root.path());
  EXPECT_EQ(available.bytes, 3500000);
  EXPECT_EQ(available.source, "the control group's limit");
  write_file(root / "proc/self/cgroup", "5:cpu,memory:/old\n");
  write_file(root / "sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write_file(root / "sys/fs/cgroup/memory/memory.usage_in_bytes", "7000\n");
  write_file(root / "sys/fs/cgroup/memory/old/memory.limit_in_bytes", "2000000\n");
  write_file(root / "sys/fs/cgroup/memory/old/memory.usage_in_bytes", "500000\n");
  EXPECT_EQ(memory_available(root.path()).bytes, 1500000);
}

TEST(MemoryAvailable, IsUnknownWhereNothingTells) {
  const TemporaryFolder root;
  EXPECT_TRUE(std::isinf(memory_available(root.path()).bytes));
  EXPECT_GT(memory_available().bytes, 1e6);
}

}  // namespace
}  // namespace polynya::tests
