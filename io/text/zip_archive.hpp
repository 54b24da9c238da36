#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace polynya::io {

/// A ZIP archive in memory whose members are stored without compression, which every reader of ZIP files has. The same
/// members give the same bytes: each has the date 1 January 1980, the earliest that the format has.
class ZipArchive {
 public:
  /// Adds a member. Its name has / between folders and does not begin with one.
  void add(std::string_view name, std::string_view bytes);
  /// Returns the bytes of the archive with the members added so far.
  std::string bytes() const;

  /// Largest archive that the format holds without its extension for large files [bytes].
  static constexpr std::uint64_t kLargest = 0xffffffff;

 private:
  std::string members_;    ///< headers and bytes of the members
  std::string directory_;  ///< one entry per member
  /// Number of members.
  std::uint16_t count_ = 0;
};

}  // namespace polynya::io
