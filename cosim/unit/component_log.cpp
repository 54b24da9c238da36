#include "cosim/unit/component.hpp"

namespace polynya::cosim {
namespace {

/// The standard gives # a meaning in messages: a doubled one is the character itself.
std::string doubled(const std::string& message) {
  std::string result;
  for (const char c : message) result.append(c == '#' ? 2 : 1, c);
  return result;
}

}  // namespace

void Component::log(fmi2Status status, const char* category, const std::string& message) const {
  const bool is_asked_for =
      is_logging && (categories.empty() || categories.contains("logAll") || categories.contains(category));
  const bool is_error = status == fmi2Error || status == fmi2Fatal;
  if (callbacks.logger == nullptr || (!is_asked_for && !is_error)) return;
  callbacks.logger(callbacks.componentEnvironment, name.c_str(), status, category, "%s", doubled(message).c_str());
}

fmi2Status Component::discard(const std::string& message) const {
  log(fmi2Discard, "logStatusDiscard", message);
  return fmi2Discard;
}

fmi2Status Component::error(const std::string& message) {
  log(fmi2Error, "logStatusError", message);
  mode = Mode::kError;
  return fmi2Error;
}

fmi2Status Component::fatal(const std::string& message) {
  log(fmi2Fatal, "logStatusFatal", message);
  mode = Mode::kFatal;
  return fmi2Fatal;
}

void Component::log_events() const {
  const std::string& events = run_->events();
  for (std::size_t from = 0; from < events.size();) {
    const std::size_t end = events.find('\n', from);
    log(fmi2OK, "logEvents", events.substr(from, end - from));
    from = end == std::string::npos ? events.size() : end + 1;
  }
}

}  // namespace polynya::cosim
