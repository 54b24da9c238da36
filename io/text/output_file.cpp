#include "io/text/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace polynya::io {
namespace {

tl::unexpected<std::string> failed(const std::filesystem::path& path, int error) {
  return fail(fmt::format("{}: {}", path.string(), std::strerror(error)));
}

tl::unexpected<std::string> failed_in_run_folder(const std::filesystem::path& path, int error) {
  if (error != ELOOP) return failed(path, error);
  return fail(fmt::format("{}: a link; polynya writes through no link in a run folder", path.string()));
}

/// Creates a new file and removes whatever had its name. Returns a negative number and sets errno on failure.
int open_new(const char* path) {
  if (::unlink(path) != 0 && errno != ENOENT) return -1;
  return ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

/// Writes the bytes. Returns how many were written; if not all were, errno is the reason.
std::size_t write_all(int descriptor, std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

/// An empty buffer with more memory than this gives it back [bytes].
constexpr std::size_t kMuchKept = std::size_t{4} << 20;

}  // namespace

bool Descriptor::close() {
  const int opened = std::exchange(opened_, -1);
  return opened < 0 || ::close(opened) == 0;
}

Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  Descriptor descriptor(open_new(path.c_str()));
  if (descriptor < 0) return failed_in_run_folder(path, errno);
  return OutputFile(std::move(descriptor), path.string());
}

Result<OutputFile> OutputFile::reopen(const std::filesystem::path& path, const Checksum& then) {
  // O_NONBLOCK: opening a pipe without a reader then fails at once instead of waiting for one.
  Descriptor descriptor(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (descriptor < 0) return failed_in_run_folder(path, errno);
  const auto refuse = [&](const std::string& reason) { return fail(fmt::format("{}: {}", path.string(), reason)); };
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return refuse(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) return refuse("not a regular file");
  if (static_cast<std::uint64_t>(status.st_size) < then.size())
    return refuse(fmt::format("{} bytes; there were {}", status.st_size, then.size()));
  const auto end = static_cast<off_t>(then.size());
  if (::ftruncate(descriptor, end) != 0 || ::lseek(descriptor, end, SEEK_SET) != end)
    return refuse(std::strerror(errno));
  OutputFile file(std::move(descriptor), path.string());
  file.written_ = then;
  return file;
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) flush();
}

bool OutputFile::flush() {
  if (!status_) return false;
  const std::size_t written = write_all(descriptor_, buffer_);
  std::size_t whole = written;
  if (written < buffer_.size()) {
    status_ = failed(name_, errno);
    const auto beyond = std::ranges::upper_bound(record_ends_, written);
    whole = beyond == record_ends_.begin() ? 0 : *(beyond - 1);
    if (::ftruncate(descriptor_, static_cast<off_t>(written_.size() + whole)) != 0)
      status_.error() += "; its last record is cut short";
  }
  written_.add(std::string_view(buffer_).substr(0, whole));
  drop();
  // The records of all floes at the start are by far the largest; later ones need less memory.
  if (buffer_.capacity() > kMuchKept) {
    buffer_.shrink_to_fit();
    record_ends_.shrink_to_fit();
  }
  return status_.has_value();
}

bool OutputFile::sync() {
  if (flush() && ::fsync(descriptor_) != 0) status_ = failed(name_, errno);
  return status_.has_value();
}

bool is_still_at(int descriptor, const std::filesystem::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

Result<> remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) return fail(fmt::format("{}: {}", path.string(), error.message()));
  return {};
}

Result<> sync_folder(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder.empty() ? "." : folder;
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY));
  if (descriptor < 0 && errno == EACCES) return {};
  if (descriptor < 0 || (::fsync(descriptor) != 0 && errno != EINVAL)) return failed_in_run_folder(path, errno);
  return {};
}

namespace {

/// Fails if `path` is something that may not be replaced: neither a regular file nor a link.
Result<> check_replaceable(const std::filesystem::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode) || S_ISLNK(status.st_mode)) return {};
  return fail(fmt::format("{}: {}; it stays as it is", path.string(),
                          S_ISDIR(status.st_mode) ? "a folder" : "not a regular file"));
}

/// Returns the path to which a chain of links leads, even if it does not exist. The kernel limits the length of chains.
std::filesystem::path end_of_links(std::filesystem::path path) {
  std::error_code error;
  while (std::filesystem::is_symlink(path, error))
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  return path;
}

}  // namespace

Result<> write_named_file(const std::filesystem::path& path, std::string_view text) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error == std::errc::too_many_symbolic_link_levels)
    return fail(fmt::format("{}: {}", path.string(), error.message()));
  if (!exists(status) || is_regular_file(status) || is_directory(status))
    return write_whole_file(end_of_links(path), text);
  Descriptor descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC));  // a pipe or a device
  if (descriptor < 0 || write_all(descriptor, text) != text.size() || !descriptor.close()) return failed(path, errno);
  return {};
}

namespace {

/// A file under a temporary name. The destructor removes it unless finish() has given it its name.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& path)
      : path_(path), temporary_(temporary_name(path)), descriptor_(open_new(temporary_.c_str())) {
    if (descriptor_ < 0) error_ = errno;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!is_finished_) ::unlink(temporary_.c_str());
  }

  void write(std::string_view part) {
    if (error_ == 0 && write_all(descriptor_, part) != part.size()) error_ = errno;
  }

  /// Renames the file to its name. Returns an error number, 0 if all went well.
  int finish(bool is_synced) {
    if (error_ == 0 && is_synced && ::fsync(descriptor_) != 0) error_ = errno;
    if (!descriptor_.close() && error_ == 0) error_ = errno;
    if (error_ == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) error_ = errno;
    is_finished_ = error_ == 0;
    return error_;
  }

 private:
  const std::filesystem::path& path_;
  std::filesystem::path temporary_;
  Descriptor descriptor_;
  int error_ = 0;
  bool is_finished_ = false;
};

}  // namespace

Result<> write_whole_file(const std::filesystem::path& path, std::string_view text, Durability durability) {
  return write_whole_file_in_parts(
      path, [text](const WritePart& write) { write(text); }, durability);
}

Result<> write_whole_file_in_parts(const std::filesystem::path& path,
                                   const std::function<void(const WritePart&)>& produce, Durability durability) {
  if (auto replaceable = check_replaceable(path); !replaceable) return replaceable;
  const bool is_synced = durability == Durability::kSynced;
  {
    TemporaryFile file(path);
    produce([&file](std::string_view part) { file.write(part); });
    if (const int error = file.finish(is_synced); error != 0) return failed(path, error);
  }
  if (is_synced) return sync_folder(path.parent_path());
  return {};
}

}  // namespace polynya::io
