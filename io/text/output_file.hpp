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
  /// Takes over a descriptor, as open() returns it; negative: there is no file.
  explicit Descriptor(int opened) : opened_(opened) {}
  Descriptor(Descriptor&& other) noexcept : opened_(std::exchange(other.opened_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(opened_, other.opened_);
    return *this;
  }
  ~Descriptor() { close(); }
  operator int() const { return opened_; }  ///< the descriptor, for calls of the system; negative: no file
  /// Closes the file. Returns false and sets errno if data that were written could not be stored. The destructor
  /// ignores such an error. Does nothing, and returns true, if there is no file.
  bool close();

 private:
  int opened_;
};

/// Returns true if the path still names the open file, and not a link to it or another file. Returns false if it names
/// nothing.
bool is_still_at(int descriptor, const std::filesystem::path& path);

/// A file that grows by whole records, such as a line or a frame. Records are buffered until flush(), sync() or the
/// destructor writes them. If a write fails half way, for example on a full disk, the file is cut back to its last
/// whole record. Symbolic links are not followed, because a run folder may come from somebody else.
class OutputFile {
 public:
  /// Creates an empty file. A file or link that already has its name is removed; a folder of that name, or a missing
  /// folder above it, is an error. All errors of this class begin with the path.
  static Result<OutputFile> create(const std::filesystem::path& path);
  /// Opens a file to append to it. `then` is the checksum of the part that is valid, from a checkpoint. The caller has
  /// compared it with the file. Bytes beyond the size of that part are cut off. A shorter file, a link, or anything
  /// that is not a regular file, is refused and not changed.
  static Result<OutputFile> reopen(const std::filesystem::path& path, const Checksum& then);
  OutputFile(OutputFile&&) noexcept = default;
  ~OutputFile();

  /// Adds a whole record to the buffer.
  void append(std::string_view record) {
    buffer_ += record;
    record_ends_.push_back(buffer_.size());
  }
  std::size_t buffered() const { return buffer_.size(); }  ///< size of the records not yet written [bytes]

  /// Writes the buffer to the file, which then survives the end of the process. Returns false on a failure. After a
  /// failure nothing more is written, status() keeps the failure, and all further calls return false.
  bool flush();
  /// Does the same and waits until the disk has stored the file, which then survives a failure of the machine.
  bool sync();
  std::uint64_t size() const { return written_.size(); }  ///< size of the written part, without the buffer [bytes]
  /// Returns the checksum of the bytes that were written, computed before they were handed to the disk. If the disk
  /// changes them, the checksum of the file differs from this one.
  const Checksum& checksum() const { return written_; }
  /// Returns true if the file still has its name, so that it was neither removed nor replaced.
  bool is_in_place() const { return is_still_at(descriptor_, name_); }
  const std::string& name() const { return name_; }  ///< path with which the file was opened
  /// Discards the buffer without writing it.
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

/// Guarantee that a finished write gives. In both cases there is never a part of a file under its name.
enum class Durability {
  kRenamed,  ///< the file stays if the program is killed afterwards, but may be lost if the machine fails
  kSynced,   ///< the file also stays if the machine fails; takes longer, because it waits for the disk
};

/// Waits until the disk has stored which names a folder contains. Without it, a new file may be lost if the machine
/// fails, even if its contents were stored. Does nothing on file systems that cannot do this, and for folders that
/// cannot be read.
Result<> sync_folder(const std::filesystem::path& folder);

/// Removes a file, a symbolic link (not the file to which it leads) or an empty folder. It is no error if there is
/// none; a folder that is not empty is one.
Result<> remove_file(const std::filesystem::path& path);

/// Returns the name under which write_whole_file() writes a file before it is renamed. If the program is killed
/// meanwhile, a file of that name remains; the next call for the same path replaces it.
inline std::filesystem::path temporary_name(std::filesystem::path path) {
  return path += ".part";
}

/// Writes a file of a run folder in one step: under a temporary name beside it, which is then renamed, so that a reader
/// finds either the old file or the new one. A symbolic link of that name is replaced, not followed, because a run
/// folder may come from somebody else. A pipe, a device or a folder is refused and stays. After an error the old file
/// stays, except that with kSynced the last step, storing the folder, may fail after the new file has its name.
Result<> write_whole_file(const std::filesystem::path& path, std::string_view text,
                          Durability durability = Durability::kRenamed);

/// Writes a long text in the same way, in parts, so that it need not be in memory as a whole. `produce` passes each
/// part to the function that it receives. An exception of `produce` is passed on, and the old file stays.
using WritePart = std::function<void(std::string_view)>;
Result<> write_whole_file_in_parts(const std::filesystem::path& path,
                                   const std::function<void(const WritePart&)>& produce,
                                   Durability durability = Durability::kRenamed);

/// Writes to a name that a user gave, for example with --out. A regular file is replaced in one step, and for a link
/// the file to which it leads, even if that file does not exist yet. A pipe or a device is written to. A folder is
/// refused. The file survives the end of the program, but not surely a failure of the machine (Durability::kRenamed).
Result<> write_named_file(const std::filesystem::path& path, std::string_view text);

}  // namespace polynya::io
