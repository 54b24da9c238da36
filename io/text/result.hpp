#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace polynya::io {

/// A value, or in words why there is none: with the file, the place and the number where there are any.
template <class Value = void>
using Result = tl::expected<Value, std::string>;

inline tl::unexpected<std::string> fail(std::string reason) {
  return tl::unexpected<std::string>(std::move(reason));
}

/// The error's text, or nothing, for callers that gather problems.
inline std::string problem_of(const Result<>& result) {
  return result ? "" : result.error();
}

}  // namespace polynya::io
