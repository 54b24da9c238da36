// The functions of the standard that read and set variables.
#include <cmath>

#include "cosim/unit/calls.hpp"
#include <fmt/format.h>

using polynya::cosim::call;
using polynya::cosim::Causality;
using polynya::cosim::Component;
using polynya::cosim::Mode;
using polynya::cosim::Variable;
using polynya::cosim::VariableType;

namespace {

/// Returns true if a variable has the type of a function's values. Enumerations are read as integers.
bool is_of(VariableType type, fmi2Real) {
  return type == VariableType::kReal;
}
bool is_of(VariableType type, fmi2Integer) {
  return type == VariableType::kInteger || type == VariableType::kControl;
}
/// fmi2Boolean is an int too: what distinguishes it is the function.
struct Truth {
  fmi2Boolean value;
};
bool is_of(VariableType type, Truth) {
  return type == VariableType::kBoolean;
}

double number_of(fmi2Real value) {
  return value;
}
double number_of(fmi2Integer value) {
  return value;
}
double number_of(Truth value) {
  return value.value != fmi2False ? 1 : 0;
}

void store(double number, fmi2Real& value) {
  value = number;
}
void store(double number, fmi2Integer& value) {
  value = static_cast<fmi2Integer>(number);
}
void store(double number, Truth& value) {
  value.value = number != 0 ? fmi2True : fmi2False;
}

/// Returns the problem of the references of a call for values of type Value; empty if there is none.
template <class Value>
std::string problem_of(const Component& c, const fmi2ValueReference references[], size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (references[i] >= c.variables().size()) return fmt::format("no variable has the reference {}", references[i]);
    const Variable& v = c.variables()[references[i]];
    if (!is_of(v.type, Value{})) return fmt::format("{} (reference {}) is of another type", v.name, references[i]);
  }
  return {};
}

/// Why a variable cannot be set now; empty if it can be.
std::string refusal_of(const Component& c, const Variable& v) {
  if (v.causality != Causality::kInput && v.causality != Causality::kParameter)
    return fmt::format("{} is an output", v.name);
  if (v.causality == Causality::kParameter && c.mode == Mode::kStepping)
    return fmt::format("{} is a fixed parameter: it can be set until initialization ends", v.name);
  return {};
}

template <class Value>
fmi2Status get(fmi2Component component, const char* name, const fmi2ValueReference references[], size_t count,
               Value values[]) {
  return call(component, name, {Mode::kInitialization, Mode::kStepping, Mode::kTerminated, Mode::kError},
              [&](Component& c) {
                if (!polynya::cosim::is_there(references, count) || !polynya::cosim::is_there(values, count))
                  return c.error(fmt::format("{}: a list is null", name));
                if (const std::string problem = problem_of<Value>(c, references, count); !problem.empty())
                  return c.error(fmt::format("{}: {}", name, problem));
                if (c.mode == Mode::kInitialization)
                  if (const auto ready = c.make_ready(); !ready) return c.error(ready.error());
                for (size_t i = 0; i < count; ++i) store(c.value(references[i]), values[i]);
                return fmi2OK;
              });
}

/// All values of a call are set, or none is.
template <class Value>
fmi2Status set(fmi2Component component, const char* name, const fmi2ValueReference references[], size_t count,
               const Value values[]) {
  return call(component, name, {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping}, [&](Component& c) {
    if (!polynya::cosim::is_there(references, count) || !polynya::cosim::is_there(values, count))
      return c.error(fmt::format("{}: a list is null", name));
    if (const std::string problem = problem_of<Value>(c, references, count); !problem.empty())
      return c.error(fmt::format("{}: {}", name, problem));
    for (size_t i = 0; i < count; ++i) {
      const Variable& v = c.variables()[references[i]];
      if (const std::string refusal = refusal_of(c, v); !refusal.empty())
        return c.error(fmt::format("{}: {}", name, refusal));
      const double number = number_of(values[i]);
      if (!(number >= v.least && number <= v.most) || !std::isfinite(number))
        return c.discard(fmt::format("{}: {} is {}, allowed: {} to {}", name, v.name, number, v.least, v.most));
    }
    for (size_t i = 0; i < count; ++i) c.set(references[i], number_of(values[i]));
    return fmi2OK;
  });
}

/// A unit of this kind has no texts.
template <class Values>
fmi2Status refuse_texts(fmi2Component component, const char* name, const fmi2ValueReference references[], size_t count,
                        Values) {
  return call(component, name,
              {Mode::kInstantiated, Mode::kInitialization, Mode::kStepping, Mode::kTerminated, Mode::kError},
              [&](Component& c) {
                if (count == 0) return fmi2OK;
                return c.error(fmt::format("{}: no variable is a text{}", name,
                                           references ? fmt::format(" (reference {})", references[0]) : ""));
              });
}

static_assert(sizeof(Truth) == sizeof(fmi2Boolean), "lists of truth values are lists of the standard's");

}  // namespace

POLYNYA_EXPORT fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                      fmi2Real values[]) {
  return get(component, "fmi2GetReal", references, count, values);
}

POLYNYA_EXPORT fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                         fmi2Integer values[]) {
  return get(component, "fmi2GetInteger", references, count, values);
}

POLYNYA_EXPORT fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                         fmi2Boolean values[]) {
  return get(component, "fmi2GetBoolean", references, count, reinterpret_cast<Truth*>(values));
}

POLYNYA_EXPORT fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                        fmi2String values[]) {
  return refuse_texts(component, "fmi2GetString", references, count, values);
}

POLYNYA_EXPORT fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                      const fmi2Real values[]) {
  return set(component, "fmi2SetReal", references, count, values);
}

POLYNYA_EXPORT fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                         const fmi2Integer values[]) {
  return set(component, "fmi2SetInteger", references, count, values);
}

POLYNYA_EXPORT fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                         const fmi2Boolean values[]) {
  return set(component, "fmi2SetBoolean", references, count, reinterpret_cast<const Truth*>(values));
}

POLYNYA_EXPORT fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                        const fmi2String values[]) {
  return refuse_texts(component, "fmi2SetString", references, count, values);
}
