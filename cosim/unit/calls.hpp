#pragma once

#include <exception>
#include <initializer_list>
#include <new>
#include <string>

#include "cosim/unit/component.hpp"

/// A function that a master finds by its name. The library shows no others.
#ifdef _WIN32
#define POLYNYA_EXPORT extern "C" __declspec(dllexport)
#else
#define POLYNYA_EXPORT extern "C" __attribute__((visibility("default")))
#endif

namespace polynya::cosim {

/// Calls `work` with an instance, as a function of the standard does: the call must be allowed in the instance's mode,
/// and no exception leaves it. `name` is the name of the function. Returns fmi2Error if there
/// is no instance.
template <class Work>
fmi2Status call(fmi2Component component, const char* name, std::initializer_list<Mode> allowed, Work work) {
  auto* const instance = static_cast<Component*>(component);
  if (instance == nullptr) return fmi2Error;
  if (instance->mode == Mode::kFatal) return fmi2Fatal;
  bool is_allowed = false;
  for (const Mode mode : allowed) is_allowed = is_allowed || mode == instance->mode;
  try {
    if (!is_allowed)
      return instance->error(std::string(name) + ": not allowed now, by the order of calls of the standard");
    return work(*instance);
  } catch (const std::bad_alloc&) {
    return instance->fatal(std::string(name) + ": out of memory");
  } catch (const std::exception& error) {
    return instance->fatal(std::string(name) + ": " + error.what());
  }
}

/// Returns true if a list of `count` items may be read or written at an address.
inline bool is_there(const void* list, std::size_t count) {
  return list != nullptr || count == 0;
}

}  // namespace polynya::cosim
