// What is known of memory before a run: how much there is, and whether a scene may fit.
#include <cmath>

#include "../io/expect_text.hpp"
#include "../io/temporary_folder.hpp"
#include <sys/resource.h>

#include "app/run/memory.hpp"

namespace polynya::app {
namespace {

using tests::TemporaryFolder;

void put(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const std::filesystem::path path = folder / name;
  std::filesystem::create_directories(path.parent_path());
  tests::write_file(path, text);
}

TEST(MemoryAvailable, IsWhatTheMachineHasFreeWithSwapAndWhatThisProcessHas) {
  const TemporaryFolder root;
  put(root, "proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    3000 kB\nSwapFree: 1000 kB\n");
  put(root, "proc/self/statm", "100 0 0 0 0 0 0\n");
  EXPECT_EQ(memory_available(root.path()).bytes, 4000 * 1024);
  put(root, "proc/self/statm", "100 10 0 0 0 0 0\n");
  EXPECT_GT(memory_available(root.path()).bytes, 4000 * 1024);
}

TEST(MemoryAvailable, IsTheLeastThatAControlGroupLeaves) {
  const TemporaryFolder root;
  put(root, "proc/meminfo", "MemAvailable:    30000 kB\n");
  put(root, "proc/self/cgroup", "0::/jobs/mine\n");
  put(root, "sys/fs/cgroup/jobs/mine/memory.max", "max\n");
  put(root, "sys/fs/cgroup/jobs/mine/memory.current", "50\n");
  put(root, "sys/fs/cgroup/jobs/memory.max", "5000000\n");
  put(root, "sys/fs/cgroup/jobs/memory.current", "4000000\n");
  put(root, "sys/fs/cgroup/jobs/memory.stat", "anon 1000000\nfile 2500000\n");
  const MemoryAvailable available = memory_available(root.path());
  EXPECT_EQ(available.bytes, 3500000);
  EXPECT_EQ(available.source, "the control group's limit");
  put(root, "proc/self/cgroup", "5:cpu,memory:/old\n");
  put(root, "sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  put(root, "sys/fs/cgroup/memory/memory.usage_in_bytes", "7000\n");
  put(root, "sys/fs/cgroup/memory/old/memory.limit_in_bytes", "2000000\n");
  put(root, "sys/fs/cgroup/memory/old/memory.usage_in_bytes", "500000\n");
  EXPECT_EQ(memory_available(root.path()).bytes, 1500000);
}

TEST(MemoryAvailable, IsUnknownWhereNothingTells) {
  const TemporaryFolder root;
  EXPECT_TRUE(std::isinf(memory_available(root.path()).bytes));
  EXPECT_GT(memory_available().bytes, 1e6);
}

TEST(MemoryCheck, RefusesWhatSurelyDoesNotFitAndNotesWhatMayNot) {
  simulation::Scene scene;
  const geometry::Ring square{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  scene.floes.assign(1000, {{square, {}}, {}, 0});
  const auto said_of = [&](double bytes, bool expected) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(may_fit(scene, "scene.json", {bytes, "a limit"}), expected);
    return testing::internal::GetCapturedStderr();
  };
  const std::string refusal = said_of(200e3, false);
  EXPECT_HAS(refusal,
             "scene.json: 1000 floes take at least 1 MB of memory, and there are 0 MB (a limit); "
             "nothing was written");
  EXPECT_HAS(said_of(3e6, true), "note: scene.json: the run takes about");
  EXPECT_EQ(said_of(1e9, true), "");
}

}  // namespace
}  // namespace polynya::app
