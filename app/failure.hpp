#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "app/exit_code.hpp"

namespace polynya::app {

/// Why a command ends: its exit code, and the message, which is still to be printed.
struct Failure {
  ExitCode code;
  std::string words;
};
template <class Value>
using Outcome = tl::expected<Value, Failure>;

inline tl::unexpected<Failure> failure(ExitCode code, std::string words) {
  return tl::unexpected(Failure{code, std::move(words)});
}

}  // namespace polynya::app
