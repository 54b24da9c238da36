#pragma once

#include <filesystem>
#include <utility>

#include "io/text/result.hpp"

namespace polynya::io {

/// Keeps other processes from writing a run folder as long as it lives: a lock on the folder's file
/// `.polynya`, which ends with the process, however that ends. The file stays: it marks the folder as a
/// run's, and a file that is never replaced can be locked by one process only.
class RunLock {
 public:
  /// Makes the file where there is none. The error names what is in the way.
  static Result<RunLock> take(const std::filesystem::path& folder);
  RunLock(RunLock&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), folder_(std::move(other.folder_)) {}
  RunLock& operator=(RunLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(folder_, other.folder_);
    return *this;
  }
  ~RunLock();

  const std::filesystem::path& folder() const { return folder_; }

  /// Whether the folder is still there under its name: it was neither removed, moved nor replaced.
  bool is_in_place() const;

 private:
  RunLock(int descriptor, std::filesystem::path folder) : descriptor_(descriptor), folder_(std::move(folder)) {}
  int descriptor_ = -1;
  std::filesystem::path folder_;
};

}  // namespace polynya::io
