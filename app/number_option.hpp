#pragma once

#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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
