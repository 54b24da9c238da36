// The functions of the standard that save and restore instances. A saved instance is a text of bytes.
#include <cstring>
#include <memory>

#include "cosim/unit/calls.hpp"

using polynya::cosim::call;
using polynya::cosim::Component;
using polynya::cosim::Mode;

namespace {

constexpr std::initializer_list<Mode> kWell = {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping,
                                               Mode::kTerminated};
constexpr std::initializer_list<Mode> kWellOrError = {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping,
                                                      Mode::kTerminated, Mode::kError};

std::string* bytes_of(fmi2FMUstate state) {
  return static_cast<std::string*>(state);
}

}  // namespace

POLYNYA_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return call(component, "fmi2GetFMUstate", kWell, [&](Component& c) {
    if (state == nullptr) return c.error("fmi2GetFMUstate: the state's place is null");
    std::string saved = c.save();
    if (*state == nullptr)
      *state = new std::string(std::move(saved));
    else
      *bytes_of(*state) = std::move(saved);  // a state that the other side hands back is overwritten
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return call(component, "fmi2SetFMUstate", kWellOrError, [&](Component& c) {
    if (state == nullptr) return c.error("fmi2SetFMUstate: the state is null");
    const auto done = c.restore(*bytes_of(state));
    return done ? fmi2OK : c.error("fmi2SetFMUstate: " + done.error());
  });
}

POLYNYA_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return call(component, "fmi2FreeFMUstate", kWellOrError, [&](Component&) {
    if (state == nullptr) return fmi2OK;
    delete bytes_of(*state);
    *state = nullptr;
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, size_t* size) {
  return call(component, "fmi2SerializedFMUstateSize", kWellOrError, [&](Component& c) {
    if (state == nullptr || size == nullptr) return c.error("fmi2SerializedFMUstateSize: state or size is null");
    *size = bytes_of(state)->size();
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                                size_t size) {
  return call(component, "fmi2SerializeFMUstate", kWellOrError, [&](Component& c) {
    if (state == nullptr || bytes == nullptr || size < bytes_of(state)->size())
      return c.error("fmi2SerializeFMUstate: state or bytes is null, or there is too little room");
    std::memcpy(bytes, bytes_of(state)->data(), bytes_of(state)->size());
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], size_t size,
                                                  fmi2FMUstate* state) {
  return call(component, "fmi2DeSerializeFMUstate", kWellOrError, [&](Component& c) {
    if (bytes == nullptr || state == nullptr) return c.error("fmi2DeSerializeFMUstate: bytes or state is null");
    *state = new std::string(bytes, size);
    return fmi2OK;
  });
}
