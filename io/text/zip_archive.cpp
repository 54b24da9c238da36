#include "io/text/zip_archive.hpp"

#include "io/text/checksum.hpp"

namespace polynya::io {
namespace {

constexpr std::uint16_t kZipVersion = 20;                 ///< version of the format that a reader needs: 2.0
constexpr std::uint16_t kUtf8Names = 1 << 11;             ///< flag: names are UTF-8
constexpr std::uint16_t kDate = (0 << 9) | (1 << 5) | 1;  ///< 1 January 1980
constexpr std::uint16_t kMadeOnUnix = 3 << 8;
constexpr std::uint32_t kRegularFile = 0100755u << 16;  ///< kind and permissions of a file in Unix notation

/// Appends a number, its lowest byte first.
template <class Number>
void put(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    bytes += static_cast<char>((static_cast<std::uint64_t>(number) >> (8 * i)) & 0xff);
}

/// The fields that a member's header and its directory entry have in common.
void put_common(std::string& bytes, std::string_view name, const Checksum& checksum) {
  put(bytes, kZipVersion);
  put(bytes, kUtf8Names);
  put(bytes, std::uint16_t{0});  // method 0: stored without compression
  put(bytes, std::uint16_t{0});  // time of day
  put(bytes, kDate);
  put(bytes, checksum.crc());
  put(bytes, static_cast<std::uint32_t>(checksum.size()));  // size after compression, which is none
  put(bytes, static_cast<std::uint32_t>(checksum.size()));
  put(bytes, static_cast<std::uint16_t>(name.size()));
  put(bytes, std::uint16_t{0});  // length of an extra field
}

}  // namespace

void ZipArchive::add(std::string_view name, std::string_view bytes) {
  const Checksum checksum(bytes);
  const auto offset = static_cast<std::uint32_t>(members_.size());
  put(members_, std::uint32_t{0x04034b50});
  put_common(members_, name, checksum);
  members_.append(name).append(bytes);

  put(directory_, std::uint32_t{0x02014b50});
  put(directory_, static_cast<std::uint16_t>(kMadeOnUnix | kZipVersion));
  put_common(directory_, name, checksum);
  put(directory_, std::uint16_t{0});  // length of a comment
  put(directory_, std::uint16_t{0});  // number of the disk
  put(directory_, std::uint16_t{0});  // internal attributes
  put(directory_, kRegularFile);
  put(directory_, offset);
  directory_.append(name);
  ++count_;
}

std::string ZipArchive::bytes() const {
  std::string all = members_ + directory_;
  put(all, std::uint32_t{0x06054b50});
  put(all, std::uint16_t{0});  // number of the disk
  put(all, std::uint16_t{0});
  put(all, count_);
  put(all, count_);
  put(all, static_cast<std::uint32_t>(directory_.size()));
  put(all, static_cast<std::uint32_t>(members_.size()));
  put(all, std::uint16_t{0});  // length of a comment
  return all;
}

}  // namespace polynya::io
