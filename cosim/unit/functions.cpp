// The functions of the standard that make, order and step instances. Values are in values.cpp, states in states.cpp.
#include <cmath>
#include <memory>

#include "cosim/unit/calls.hpp"
#include "cosim/unit/resource_folder.hpp"

using polynya::cosim::call;
using polynya::cosim::Component;
using polynya::cosim::Mode;

namespace {

constexpr const char* kCategories[] = {"logEvents",      "logStatusWarning", "logStatusDiscard",
                                       "logStatusError", "logStatusFatal",   "logAll"};

bool is_category(const char* name) {
  for (const char* category : kCategories)
    if (name != nullptr && std::string_view(category) == name) return true;
  return false;
}

/// A call of what this unit's modelDescription.xml states that it cannot do.
fmi2Status refuse(fmi2Component component, const char* name) {
  return call(component, name, {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping, Mode::kTerminated},
              [&](Component& c) { return c.error(std::string(name) + ": this unit cannot do that"); });
}

/// An instance, or the reason why there is none.
polynya::io::Result<std::unique_ptr<Component>> make(fmi2Type type, fmi2String guid, fmi2String resources) {
  using polynya::io::fail;
  if (type != fmi2CoSimulation) return fail("fmuType: this unit is for co-simulation alone");
  if (guid == nullptr || resources == nullptr) return fail("fmi2Instantiate: guid or fmuResourceLocation is null");
  const auto folder = polynya::cosim::folder_of(resources);
  if (!folder) return fail(folder.error());
  return Component::make(*folder, guid);
}

}  // namespace

POLYNYA_EXPORT const char* fmi2GetTypesPlatform() {
  return fmi2TypesPlatform;
}

POLYNYA_EXPORT const char* fmi2GetVersion() {
  return fmi2Version;
}

POLYNYA_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t count,
                                              const fmi2String categories[]) {
  return call(component, "fmi2SetDebugLogging",
              {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping, Mode::kTerminated, Mode::kError},
              [&](Component& c) {
                if (!polynya::cosim::is_there(categories, count))
                  return c.error("fmi2SetDebugLogging: categories is null");
                for (size_t i = 0; i < count; ++i)
                  if (!is_category(categories[i]))
                    return c.error("fmi2SetDebugLogging: no category \"" +
                                   std::string(categories[i] ? categories[i] : "") + '"');
                c.is_logging = on != fmi2False;
                c.categories = {categories, categories + count};
                return fmi2OK;
              });
}

POLYNYA_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                             const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean on) {
  const auto tell = [&](const char* message) {
    if (callbacks != nullptr && callbacks->logger != nullptr)
      callbacks->logger(callbacks->componentEnvironment, name != nullptr ? name : "", fmi2Error, "logStatusError", "%s",
                        message);
  };
  if (callbacks == nullptr) return nullptr;
  if (name == nullptr || *name == '\0') {
    tell("fmi2Instantiate: the instance has no name");
    return nullptr;
  }
  try {
    auto made = make(type, guid, resources);
    if (!made) {
      tell(made.error().c_str());
      return nullptr;
    }
    (*made)->name = name;
    (*made)->callbacks = *callbacks;
    (*made)->is_logging = on != fmi2False;
    return made->release();
  } catch (const std::exception& error) {
    tell(error.what());
    return nullptr;
  }
}

POLYNYA_EXPORT void fmi2FreeInstance(fmi2Component component) {
  delete static_cast<Component*>(component);
}

POLYNYA_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real, fmi2Real start,
                                              fmi2Boolean has_stop, fmi2Real stop) {
  return call(component, "fmi2SetupExperiment", {Mode::kInstantiated}, [&](Component& c) {
    if (!std::isfinite(start) || (has_stop && !(stop >= start)))
      return c.error("fmi2SetupExperiment: the start time is no number, or the stop time lies before it");
    c.set_experiment(start, has_stop ? std::optional(stop) : std::nullopt);
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return call(component, "fmi2EnterInitializationMode", {Mode::kInstantiated}, [&](Component& c) {
    if (!c.has_experiment()) return c.error("fmi2EnterInitializationMode: fmi2SetupExperiment has not been called");
    c.mode = Mode::kInitialization;
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return call(component, "fmi2ExitInitializationMode", {Mode::kInitialization}, [&](Component& c) {
    if (const auto ready = c.make_ready(); !ready) return c.error(ready.error());
    c.mode = Mode::kStepping;
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2Terminate(fmi2Component component) {
  return call(component, "fmi2Terminate", {Mode::kStepping}, [](Component& c) {
    c.mode = Mode::kTerminated;
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2Reset(fmi2Component component) {
  return call(component, "fmi2Reset",
              {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping, Mode::kTerminated, Mode::kError},
              [](Component& c) {
                c.reset();
                return fmi2OK;
              });
}

POLYNYA_EXPORT fmi2Status fmi2DoStep(fmi2Component component, fmi2Real from, fmi2Real length, fmi2Boolean) {
  return call(component, "fmi2DoStep", {Mode::kStepping}, [&](Component& c) { return c.do_step(from, length); });
}

POLYNYA_EXPORT fmi2Status fmi2CancelStep(fmi2Component component) {
  return refuse(component, "fmi2CancelStep");
}

POLYNYA_EXPORT fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind, fmi2Status*) {
  return call(component, "fmi2GetStatus", {Mode::kStepping, Mode::kTerminated},
              [](Component& c) { return c.discard("fmi2GetStatus: no step is ever pending"); });
}

POLYNYA_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real* value) {
  return call(component, "fmi2GetRealStatus", {Mode::kStepping, Mode::kTerminated}, [&](Component& c) {
    if (value == nullptr) return c.error("fmi2GetRealStatus: value is null");
    if (kind != fmi2LastSuccessfulTime) return c.discard("fmi2GetRealStatus: there is only fmi2LastSuccessfulTime");
    *value = c.time();
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind, fmi2Integer*) {
  return call(component, "fmi2GetIntegerStatus", {Mode::kStepping, Mode::kTerminated},
              [](Component& c) { return c.discard("fmi2GetIntegerStatus: the standard has no such status"); });
}

POLYNYA_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind, fmi2Boolean* value) {
  return call(component, "fmi2GetBooleanStatus", {Mode::kStepping, Mode::kTerminated}, [&](Component& c) {
    if (value == nullptr) return c.error("fmi2GetBooleanStatus: value is null");
    if (kind != fmi2Terminated) return c.discard("fmi2GetBooleanStatus: there is only fmi2Terminated");
    *value = fmi2False;  // a run never ends by itself
    return fmi2OK;
  });
}

POLYNYA_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind, fmi2String*) {
  return call(component, "fmi2GetStringStatus", {Mode::kStepping, Mode::kTerminated},
              [](Component& c) { return c.discard("fmi2GetStringStatus: no step is ever pending"); });
}

POLYNYA_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference[], size_t,
                                                       const fmi2ValueReference[], size_t, const fmi2Real[],
                                                       fmi2Real[]) {
  return refuse(component, "fmi2GetDirectionalDerivative");
}

POLYNYA_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference[], size_t,
                                                      const fmi2Integer[], const fmi2Real[]) {
  return refuse(component, "fmi2SetRealInputDerivatives");
}

POLYNYA_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference[], size_t,
                                                       const fmi2Integer[], fmi2Real[]) {
  return refuse(component, "fmi2GetRealOutputDerivatives");
}
