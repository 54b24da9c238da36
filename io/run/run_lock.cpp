#include "io/run/run_lock.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/run/run_folder.hpp"

namespace polynya::io {

Result<RunLock> RunLock::take(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / run_file::kLock;
  const auto refuse = [&](const std::string& reason) { return fail(fmt::format("{}: {}", file.string(), reason)); };
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0)
    return refuse(errno == ELOOP ? "a link; remove it if the folder is a run's" : std::strerror(errno));
  RunLock lock(descriptor, folder);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return refuse("not a regular file");
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return fail(fmt::format("{}: another polynya is writing this run", folder.string()));
  // File systems without locks go without.
  if (!lock.is_in_place()) return refuse("removed by another program meanwhile; try again");
  return lock;
}

bool RunLock::is_in_place() const {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor_, &opened) == 0 && ::lstat((folder_ / run_file::kLock).c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

RunLock::~RunLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace polynya::io
