#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <boost/crc.hpp>

namespace polynya::io {

/// The CRC-32 of bytes, as zlib and `crc32` compute it, and how many they are. It finds every error within 32
/// neighbouring bits, and all but one in 4·10⁹ of others.
class Checksum {
 public:
  Checksum() = default;
  explicit Checksum(std::string_view bytes) { add(bytes); }

  void add(std::string_view bytes) {
    crc_.process_bytes(bytes.data(), bytes.size());
    size_ += bytes.size();
  }
  std::uint32_t crc() const { return crc_.checksum(); }
  std::uint64_t size() const { return size_; }  ///< [bytes]

  friend bool operator==(const Checksum& a, const Checksum& b) { return a.crc() == b.crc() && a.size() == b.size(); }

 private:
  boost::crc_32_type crc_;
  std::uint64_t size_ = 0;
};

}  // namespace polynya::io
