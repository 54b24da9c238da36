#pragma once

#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace polynya::tests {

/// Returns whether all of the parts, or none of them, are in a text.
inline testing::AssertionResult has_parts(std::string_view text, std::initializer_list<std::string_view> parts,
                                          bool are_wanted) {
  for (const std::string_view part : parts) {
    if ((text.find(part) != std::string_view::npos) != are_wanted)
      return testing::AssertionFailure() << '"' << part << (are_wanted ? "\" is not" : "\" is") << " in\n" << text;
  }
  return testing::AssertionSuccess();
}

inline testing::AssertionResult begins_with(std::string_view text, std::string_view part) {
  if (text.starts_with(part)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << part << "\" does not begin\n" << text;
}

/// Returns the expected value. If the outcome is an error, the test ends with its reason.
template <class Expected>
Expected checked(Expected outcome) {
  if (outcome) return outcome;
  if constexpr (requires { std::string(outcome.error()); })
    throw std::runtime_error(std::string(outcome.error()));
  else if constexpr (requires { to_string(outcome.error().front()); })
    throw std::runtime_error(to_string(outcome.error().front()));
  else
    throw std::runtime_error("refused");
}

/// Returns the reason of a refusal. The test ends if nothing was refused.
template <class Expected>
auto refused(const Expected& outcome) {
  if (outcome) throw std::runtime_error("not refused");
  return outcome.error();
}

/// Returns the rows of a table in tests/. The cells of a line are separated by " | ", and may be empty. Lines that
/// begin with "#" are not rows.
inline std::vector<std::vector<std::string>> table_of(const std::string& file) {
  std::ifstream lines(std::string(POLYNYA_SOURCE_DIR) + "/tests/" + file);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    std::vector<std::string>& row = rows.emplace_back();
    line = " " + line + " |";
    for (std::size_t start = 0, end = 0; (end = line.find(" |", start)) != std::string::npos; start = end + 2)
      row.push_back(end > start ? line.substr(start + 1, end - start - 1) : "");
  }
  EXPECT_FALSE(rows.empty()) << file;
  return rows;
}

/// Replaces the one place of a text.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace polynya::tests

/// EXPECT_HAS(text, part...) checks that the text contains each part. EXPECT_LACKS checks that it contains none.
#define EXPECT_HAS(text, ...) EXPECT_TRUE(::polynya::tests::has_parts(text, {__VA_ARGS__}, true))
#define EXPECT_LACKS(text, ...) EXPECT_TRUE(::polynya::tests::has_parts(text, {__VA_ARGS__}, false))
#define EXPECT_BEGINS(text, part) EXPECT_TRUE(::polynya::tests::begins_with(text, part))
