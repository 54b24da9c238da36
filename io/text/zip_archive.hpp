#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace polynya::io {

/// A ZIP archive in memory, such as a co-simulation unit. Its members are stored without compression, a method that
/// every reader of ZIP files supports. The same members in the same order give the same bytes, because each has the
/// date 1 January 1980, the earliest that the format has, instead of the present one.
class ZipArchive {
 public:
  /// Adds a member after the others. Its name, in UTF-8, has / between folders and does not begin with one. Sizes are
  /// not checked: the caller must keep the archive below kLargest bytes and 65 536 members, and each name below 65 536
  /// bytes. Beyond that, the numbers in the headers wrap around, and the archive is damaged without an error.
  void add(std::string_view name, std::string_view bytes);
  /// Returns the bytes of the archive with the members added so far; without a member, a valid empty archive. More
  /// members can be added afterwards.
  std::string bytes() const;

  /// Largest archive that the format holds without its extension for large files [bytes]: offsets and sizes have 32
  /// bits. A larger archive would be unreadable.
  static constexpr std::uint64_t kLargest = 0xffffffff;

 private:
  std::string members_;    ///< headers and bytes of the members: the first part of the archive
  std::string directory_;  ///< one entry per member, with the position of its header: the second part of the archive
  /// Number of members. The format has 16 bits for it.
  std::uint16_t count_ = 0;
};

}  // namespace polynya::io
