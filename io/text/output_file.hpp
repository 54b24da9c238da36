#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/checksum.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// An open file, which is closed with this.
class Descriptor {
 public:
  explicit Descriptor(int opened) : opened_(opened) {}  ///< negative: none
  Descriptor(Descriptor&& other) noexcept : opened_(std::exchange(other.opened_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(opened_, other.opened_);
    return *this;
  }
  ~Descriptor() { close(); }
  operator int() const { return opened_; }
  /// Whether all that was written is where it belongs; errno is why not.
  bool close();

 private:
  int opened_;
};

/// Whether an open file still has that name.
bool is_still_at(int descriptor, const std::filesystem::path& path);

/// A file that grows by whole records (a line, a frame). Records are buffered; what is on disk always ends
/// with a whole one: where a write fails half way, the file is cut back to the last whole record. Links are
/// not followed: run folders come from elsewhere too.
class OutputFile {
 public:
  /// A new file; what had its name before, a link for example, is removed.
  static Result<OutputFile> create(const std::filesystem::path& path);
  /// Opens a file to append to it. `then` is the checksum when the file was last known to be whole; the caller has
  /// compared it. What is beyond its size is cut off. A shorter file, or one that is not a regular file, is refused and
  /// not changed.
  static Result<OutputFile> reopen(const std::filesystem::path& path, const Checksum& then);
  OutputFile(OutputFile&&) noexcept = default;
  ~OutputFile();

  void append(std::string_view record) {
    buffer_ += record;
    record_ends_.push_back(buffer_.size());
  }
  std::size_t buffered() const { return buffer_.size(); }  ///< [bytes]

  /// Writes what is buffered. After a failure nothing more is written and the failure stays.
  bool flush();
  /// Writes what is buffered and waits until it is on the disk.
  bool sync();
  std::uint64_t size() const { return written_.size(); }  ///< on disk [bytes]
  /// Checksum of the bytes as they were handed to the disk. If the disk changes them later, their checksum differs.
  const Checksum& checksum() const { return written_; }
  /// Whether the file still has its name: it was neither removed nor replaced.
  bool is_in_place() const { return is_still_at(descriptor_, name_); }
  const std::string& name() const { return name_; }
  /// Forgets what is buffered.
  void drop() {
    buffer_.clear();
    record_ends_.clear();
  }
  /// The failure that flush() or sync() met, with the file's name.
  const Result<>& status() const { return status_; }

 private:
  OutputFile(Descriptor descriptor, std::string name) : descriptor_(std::move(descriptor)), name_(std::move(name)) {}
  Descriptor descriptor_;
  std::string name_;
  std::string buffer_;
  std::vector<std::size_t> record_ends_;  ///< in the buffer
  Checksum written_;                      ///< of what is on disk
  Result<> status_;
};

enum class Durability {
  kRenamed,  ///< whole whatever happens to the program
  kSynced,   ///< whole, and there, whatever happens to the machine
};

/// Waits until a folder's names are on the disk. File systems that cannot, and folders that cannot be read,
/// are taken at their word.
Result<> sync_folder(const std::filesystem::path& folder);

/// Removes a file, or the link of that name, or an empty folder; one that is not there is no error.
Result<> remove_file(const std::filesystem::path& path);

/// Writes a file of a run folder at once: to a temporary name beside it, then renamed, so that a reader gets
/// the old or the new one. A link of that name is replaced, not followed: run folders come from elsewhere
/// too. A pipe, a device or a folder is refused and stays.
Result<> write_whole_file(const std::filesystem::path& path, std::string_view text,
                          Durability durability = Durability::kRenamed);

/// The same for a long text, in parts: `produce` gives each to the function it is given. What it throws is
/// passed on, and no file is left of it.
using WritePart = std::function<void(std::string_view)>;
Result<> write_whole_file_in_parts(const std::filesystem::path& path,
                                   const std::function<void(const WritePart&)>& produce,
                                   Durability durability = Durability::kRenamed);

/// Writes to a name that a user gave. A regular file is replaced at once, and behind a link its target; a
/// pipe or a device is written to.
Result<> write_named_file(const std::filesystem::path& path, std::string_view text);

}  // namespace polynya::io
