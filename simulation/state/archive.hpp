#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace polynya::simulation {

static_assert(std::endian::native == std::endian::little, "a state has the machine's number format");

/// True if T is Value or const Value. Field lists are templates that are constrained by it.
template <class T, class Value>
concept Is = std::same_as<std::remove_const_t<T>, Value>;

/// A plain number or enumeration, which is stored by its bytes.
template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// A type is saved by its field list, fields(archive, value), which passes each of its members once to the archive. The
// archives below take any number of values in each call.

/// Splits values into numbers and characters and passes them to a Sink. The length of a text or list precedes its
/// elements.
template <class Sink>
class Serializer {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }

 private:
  Sink& sink() { return static_cast<Sink&>(*this); }
  template <Number T>
  void put(const T& value) {
    sink().put_number(value);
  }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    sink().put_characters(text);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(std::uint64_t{list.size()});
    for (const T& value : list) put(value);
  }
  template <class T>
  void put(const T& value) {
    fields(sink(), value);
  }
};

/// Appends values to bytes, with numbers in the format of the machine.
class ByteWriter : public Serializer<ByteWriter> {
 public:
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  friend Serializer<ByteWriter>;
  template <Number T>
  void put_number(const T& value) {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    bytes_.append(raw.data(), raw.size());
  }
  void put_characters(const std::string& text) { bytes_ += text; }
  std::string bytes_;
};

/// Reads values that ByteWriter wrote. The bytes may be anything: it never reads beyond their end, and never makes a
/// list longer than they could hold. It keeps the first defect; all values after it are read as zero.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  /// Stores the reason of a failure, unless there is an earlier one, and ends reading.
  void fail(std::string reason) {
    if (failure_.empty()) failure_ = std::move(reason);
    bytes_ = {};
  }
  /// Fails with a reason unless the condition holds.
  void require(bool holds, const char* reason) {
    if (!holds) fail(reason);
  }
  bool is_well() const { return failure_.empty(); }
  bool is_at_end() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }  ///< number of bytes that are left
  const std::string& failure() const { return failure_; }

 private:
  template <Number T>
  void get(T& value) {
    value = T{};
    if constexpr (std::same_as<T, bool>) {
      std::uint8_t raw = 0;
      get(raw);
      require(raw <= 1, "a truth value that is neither");
      value = raw == 1;
    } else {
      if (bytes_.size() < sizeof value) return fail("it ends too early");
      std::memcpy(&value, bytes_.data(), sizeof value);
      bytes_.remove_prefix(sizeof value);
      if constexpr (std::floating_point<T>) {
        if (!std::isfinite(value)) {
          value = 0;
          fail("a number that is not finite");
        }
      }
    }
  }
  std::uint64_t get_length() {
    std::uint64_t length = 0;
    get(length);
    if (length > bytes_.size()) {
      fail("a list longer than the whole");
      return 0;
    }
    return length;
  }
  void get(std::string& text) {
    const auto length = static_cast<std::size_t>(get_length());
    text.assign(bytes_.substr(0, length));
    bytes_.remove_prefix(length);
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.clear();
    const std::uint64_t length = get_length();
    for (std::uint64_t i = 0; i < length && is_well(); ++i) get(list.emplace_back());
  }
  template <class T>
  void get(T& value) {
    fields(*this, value);
  }
  std::string_view bytes_;
  std::string failure_;
};

/// Computes a hash of values: FNV-1a [Fowler2019] over 64-bit words, one for each number. After each word the hash is
/// also mixed with its own upper half.
class HashWriter : public Serializer<HashWriter> {
 public:
  std::uint64_t hash() const { return hash_; }

 private:
  friend Serializer<HashWriter>;
  template <Number T>
  void put_number(const T& value) {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof value);
    hash_ = (hash_ ^ word) * 1099511628211U;
    hash_ ^= hash_ >> 32;
  }
  void put_characters(const std::string& text) {
    for (const char c : text) put_number(c);
  }
  std::uint64_t hash_ = 14695981039346656037U;
};

}  // namespace polynya::simulation
