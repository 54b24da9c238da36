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

}  // namespace polynya::io
