#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace polynya::app {

// fmt::print throws where its stream is a closed pipe or a full disk; `2>&1 | head` is no reason to abort.

/// Writes to stdout; whether that worked, ferror(stdout) tells at the end.
inline void say(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
}

/// Words for people on stderr, lost where it is closed.
template <typename... Args>
void tell(fmt::format_string<Args...> words, Args&&... args) {
  const std::string text = fmt::format(words, std::forward<Args>(args)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

}  // namespace polynya::app
