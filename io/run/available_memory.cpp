#include "io/run/available_memory.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

namespace polynya::io {
namespace {

namespace fs = std::filesystem;

/// Returns the number in a file; nothing if there is no such file, or if it has a word such as "max" instead.
std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double value = 0;
  if (stream >> value) return value;
  return {};
}

/// Returns the number after a key at the start of a line, as in /proc/meminfo; 0 if there is none.
double number_behind(const fs::path& file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string first;
    double value = 0;
    if (words >> first >> value && first == key) return value;
  }
  return 0;
}

void limit(MemoryAvailable& available, double bytes, const char* source) {
  if (bytes < available.bytes) available = {bytes, source};
}

void limit_by_process(MemoryAvailable& available, int resource, const char* source) {
  rlimit limits{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limits) == 0 && limits.rlim_cur != RLIM_INFINITY)
    limit(available, static_cast<double>(limits.rlim_cur), source);
}

/// Memory that this process uses now [bytes].
double resident(const fs::path& root) {
  std::ifstream stream(root / "proc/self/statm");
  double size = 0, resident_pages = 0;
  stream >> size >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Names of the files of one version of control groups.
struct GroupFiles {
  const char* folder;
  const char* limit;
  const char* used;
  const char* cache;  ///< key in memory.stat of the memory that the kernel frees on demand
};

/// Applies the limits of a group and of all groups that contain it.
void limit_by_groups(MemoryAvailable& available, const fs::path& root, const GroupFiles& files, const fs::path& group,
                     double ours) {
  for (fs::path at = group;; at = at.parent_path()) {
    const fs::path folder = root / files.folder / at.relative_path();
    const auto most = number_in(folder / files.limit);
    const auto used = number_in(folder / files.used);
    if (most && used) {
      const double cache = number_behind(folder / "memory.stat", files.cache);
      limit(available, std::fmin(*most, *most - *used + cache + ours), "the control group's limit");
    }
    if (!at.has_relative_path()) return;
  }
}

/// Applies the limits of the groups of this process. /proc/self/cgroup lists them as "0::/group" or
/// "N:controllers:/group".
void limit_by_groups(MemoryAvailable& available, const fs::path& root, double ours) {
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const auto first = line.find(':');
    const auto second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,")
      limit_by_groups(available, root, {"sys/fs/cgroup", "memory.max", "memory.current", "file"}, group, ours);
    else if (controllers.find(",memory,") != std::string::npos)
      limit_by_groups(available, root,
                      {"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_cache"}, group,
                      ours);
  }
}

}  // namespace

MemoryAvailable memory_available(const fs::path& root) {
  MemoryAvailable available{std::numeric_limits<double>::infinity(), "nothing"};
  const double ours = resident(root);
  constexpr double kKibibyte = 1024;
  const fs::path machine = root / "proc/meminfo";
  const double swap = kKibibyte * number_behind(machine, "SwapFree:");
  limit_by_groups(available, root, ours);
  available.bytes += swap;  // the limit of a group does not include swap
  if (const double free = kKibibyte * number_behind(machine, "MemAvailable:"); free > 0)
    limit(available, free + swap + ours, "what is free on this machine");
  limit_by_process(available, RLIMIT_AS, "the limit of ulimit -v");
  limit_by_process(available, RLIMIT_DATA, "the limit of ulimit -d");
  return available;
}

}  // namespace polynya::io
