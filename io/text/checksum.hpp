#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <boost/crc.hpp>

namespace polynya::io {

/// CRC-32 (the variant of zlib and of the program `crc32`) and number of the bytes added so far; both are 0 before the
/// first byte. It shows whether a file of a run, a checkpoint or the state of a co-simulation has been damaged. A
/// CRC-32 detects every error that is confined to 32 neighbouring bits. It misses one in 4·10⁹ of all other errors. It
/// gives no protection against somebody who changes a file on purpose. Files keep the number, so with another
/// polynomial the program would take all earlier files for damaged.
class Checksum {
 public:
  Checksum() = default;
  explicit Checksum(std::string_view bytes) { add(bytes); }

  /// Continues the checksum by these bytes. Any division of a text into parts gives the same checksum.
  void add(std::string_view bytes) {
    crc_.process_bytes(bytes.data(), bytes.size());
    size_ += bytes.size();
  }
  std::uint32_t crc() const { return crc_.checksum(); }  ///< of the bytes so far; more can be added afterwards
  std::uint64_t size() const { return size_; }           ///< [bytes]

  friend bool operator==(const Checksum& a, const Checksum& b) { return a.crc() == b.crc() && a.size() == b.size(); }

 private:
  boost::crc_32_type crc_;
  std::uint64_t size_ = 0;
};

}  // namespace polynya::io
