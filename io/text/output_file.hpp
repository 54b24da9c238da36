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

/// An open file descriptor. Its destructor closes it.
class Descriptor {
 public:
  explicit Descriptor(int opened) : opened_(opened) {}  ///< negative: no file
  Descriptor(Descriptor&& other) noexcept : opened_(std::exchange(other.opened_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(opened_, other.opened_);
    return *this;
  }
  ~Descriptor() { close(); }
  operator int() const { return opened_; }
  /// Closes the file. Returns false and sets errno if data that were written could not be stored.
  bool close();

 private:
  int opened_;
};

/// Returns true if an open file still has that name.
bool is_still_at(int descriptor, const std::filesystem::path& path);

/// A file that grows by whole records, such as a line or a frame. Records are buffered. The file on disk always ends
/// with a whole record: if a write fails half way, the file is cut back to the last whole one. Symbolic links are not
/// followed, because a run folder may come from somebody else.
class OutputFile {
 public:
  /// Creates the file. If something already has its name, such as a link, that is removed.
  static Result<OutputFile> create(const std::filesystem::path& path);
  /// Opens a file to append to it. `then` is its checksum at the time up to which it is valid; the caller has compared
  /// it. Bytes beyond that size are cut off. A shorter file, or one that is not a regular file, is refused and not
  /// changed.
  static Result<OutputFile> reopen(const std::filesystem::path& path, const Checksum& then);
  OutputFile(OutputFile&&) noexcept = default;
  ~OutputFile();

  void append(std::string_view record) {
    buffer_ += record;
    record_ends_.push_back(buffer_.size());
  }
  std::size_t buffered() const { return buffer_.size(); }  ///< [bytes]

  /// Writes the buffer to the file. After a failure nothing more is written, and status() keeps the failure.
  bool flush();
  /// Writes the buffer and waits until the disk has stored it.
  bool sync();
  std::uint64_t size() const { return written_.size(); }  ///< on disk [bytes]
  /// Checksum of the bytes as they were handed to the disk. If the disk changes them later, their checksum differs.
  const Checksum& checksum() const { return written_; }
  /// Returns true if the file still has its name, so that it was neither removed nor replaced.
  bool is_in_place() const { return is_still_at(descriptor_, name_); }
  const std::string& name() const { return name_; }
  /// Discards the buffer.
  void drop() {
    buffer_.clear();
    record_ends_.clear();
  }
  /// The failure that flush() or sync() met, with the name of the file; a value if there was none.
  const Result<>& status() const { return status_; }

 private:
  OutputFile(Descriptor descriptor, std::string name) : descriptor_(std::move(descriptor)), name_(std::move(name)) {}
  Descriptor descriptor_;
  std::string name_;
  std::string buffer_;
  std::vector<std::size_t> record_ends_;  ///< end of each record in the buffer [bytes]
  Checksum written_;                      ///< checksum of the bytes on disk
  Result<> status_;
};

/// Guarantee that a finished write gives.
enum class Durability {
  kRenamed,  ///< the file is complete even if the program ends at any time
  kSynced,   ///< the file is complete and stored even if the machine fails
};

/// Waits until the disk has stored the names in a folder. Does nothing on file systems that cannot do this, and for
/// folders that cannot be read.
Result<> sync_folder(const std::filesystem::path& folder);

/// Removes a file, a symbolic link or an empty folder. It is no error if there is none.
Result<> remove_file(const std::filesystem::path& path);

/// Returns the name under which write_whole_file() writes a file before it is renamed. If the program is killed
/// meanwhile, a file of that name remains.
inline std::filesystem::path temporary_name(std::filesystem::path path) {
  return path += ".part";
}

/// Writes a file of a run folder in one step: under a temporary name beside it, which is then renamed, so that a reader
/// finds either the old file or the new one. A symbolic link of that name is replaced, not followed, because a run
/// folder may come from somebody else. A pipe, a device or a folder is refused and stays.
Result<> write_whole_file(const std::filesystem::path& path, std::string_view text,
                          Durability durability = Durability::kRenamed);

/// Writes a long text in the same way, in parts: `produce` passes each part to the function that it receives. An
/// exception of `produce` is passed on, and no file is left.
using WritePart = std::function<void(std::string_view)>;
Result<> write_whole_file_in_parts(const std::filesystem::path& path,
                                   const std::function<void(const WritePart&)>& produce,
                                   Durability durability = Durability::kRenamed);

/// Writes to a name that a user gave. A regular file is replaced in one step, and for a link the file to which it
/// leads. A pipe or a device is written to.
Result<> write_named_file(const std::filesystem::path& path, std::string_view text);

}  // namespace polynya::io
