#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "app/command_line.hpp"

namespace polynya::app {

/// As CLI::Range, which accepts "nan".
inline CLI::Validator between(double least, double most) {
  return {[least, most](std::string& word) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(word, value) && value >= least && value <= most) return "";
            return fmt::format("{} is not a number from {:g} to {:g}", word, least, most);
          },
          fmt::format("{:g} to {:g}", least, most)};
}

/// For counts and seeds: "1.5 is not a whole number from 1 to 1024".
inline CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  return {[least, most](std::string& word) -> std::string {
            std::uint64_t value = 0;
            const char* const end = word.data() + word.size();
            const auto [stop, problem] = std::from_chars(word.data(), end, value);
            if (problem == std::errc() && stop == end && value >= least && value <= most) return "";
            return fmt::format("{} is not a whole number from {} to {}", word, least, most);
          },
          fmt::format("{} to {}", least, most)};
}

/// Every number but infinity and "nan".
inline CLI::Validator finite() {
  return {[](std::string& word) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(word, value) && std::isfinite(value)) return "";
            return fmt::format("{} is not a finite number", word);
          },
          ""};
}

}  // namespace polynya::app
