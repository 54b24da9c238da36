/* Variables: wrong references, wrong types, numbers that are none or out of range, and when what may be set. */
#include "checks.h"
#include <math.h>

/* A call that the instance takes as an error: it needs a new one. */
static void expect_error(const Unit* unit, fmi2Status status, fmi2Component* instance,
                         const fmi2CallbackFunctions* callbacks) {
  EXPECT(status == fmi2Error);
  unit->fmi2FreeInstance(*instance);
  *instance = ready(unit, "values", callbacks);
}

static void check_references(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(unit, "values", &callbacks);
  const fmi2ValueReference beyond = (fmi2ValueReference)unit->count, x = reference_of(unit, "icebreaker.x_m");
  const fmi2ValueReference contacts = reference_of(unit, "icebreaker.contacts");
  const fmi2ValueReference lever = reference_of(unit, "icebreaker.command.lever");
  double number = 0;
  int whole = 0;
  expect_error(unit, unit->fmi2GetReal(instance, &beyond, 1, &number), &instance, &callbacks);
  expect_error(unit, unit->fmi2SetReal(instance, &beyond, 1, &number), &instance, &callbacks);
  expect_error(unit, unit->fmi2GetReal(instance, &contacts, 1, &number), &instance, &callbacks);
  expect_error(unit, unit->fmi2GetInteger(instance, &x, 1, &whole), &instance, &callbacks);
  expect_error(unit, unit->fmi2GetBoolean(instance, &x, 1, &whole), &instance, &callbacks);
  expect_error(unit, unit->fmi2SetReal(instance, &x, 1, &number), &instance, &callbacks); /* an output */
  expect_error(unit, unit->fmi2GetReal(instance, NULL, 1, &number), &instance, &callbacks);
  expect_error(unit, unit->fmi2GetReal(instance, &x, 1, NULL), &instance, &callbacks);
  expect_error(unit, unit->fmi2GetString(instance, &x, 1, NULL), &instance, &callbacks);
  expect_error(unit, set_real(unit, instance, "ice.thickness_m", 0.5), &instance, &callbacks); /* too late */
  EXPECT(unit->fmi2GetReal(instance, NULL, 0, NULL) == fmi2OK);
  EXPECT(unit->fmi2SetReal(instance, &lever, 1, &number) == fmi2OK);
  EXPECT(unit->fmi2GetReal(NULL, &x, 1, &number) == fmi2Error);
  unit->fmi2FreeInstance(instance);
}

/* What is no number, or out of range, is refused, with all else of the call; the instance goes on. */
static void check_numbers(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(unit, "numbers", &callbacks);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 0.25) == fmi2OK);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", NAN) == fmi2Discard);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", INFINITY) == fmi2Discard);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 1.5) == fmi2Discard);
  const fmi2ValueReference both[2] = {reference_of(unit, "icebreaker.command.lever"),
                                      reference_of(unit, "icebreaker.external.surge_N")};
  const double values[2] = {0.75, NAN};
  EXPECT(unit->fmi2SetReal(instance, both, 2, values) == fmi2Discard);
  EXPECT(real(unit, instance, "icebreaker.command.lever") == 0.25);
  EXPECT(real(unit, instance, "icebreaker.external.surge_N") == 0);
  EXPECT(unit->fmi2DoStep(instance, 0, 0.1, fmi2True) == fmi2OK);
  unit->fmi2FreeInstance(instance);
}

/* Parameters are those of the scene's keys: what they change, and what the scene's rules refuse. */
static void check_parameters(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = make(unit, "parameters", &callbacks);
  EXPECT(set_real(unit, instance, "ice.thickness_m", 99) == fmi2Discard);
  EXPECT(set_real(unit, instance, "time.step_s", 0.01) == fmi2OK);
  EXPECT(set_integer(unit, instance, "seed", 12) == fmi2OK);
  EXPECT(set_integer(unit, instance, "icebreaker.control", 4) == fmi2Discard);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(real(unit, instance, "tick_s") == 0.01); /* before initialization ends */
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 0, 0.01, fmi2True) == fmi2OK);
  unit->fmi2FreeInstance(instance);

  instance = make(unit, "parameters", &callbacks);
  EXPECT(set_integer(unit, instance, "barge.control", 2) == fmi2OK); /* it has no engine */
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2Error);
  EXPECT(unit->fmi2Reset(instance) == fmi2OK);
  EXPECT(set_real(unit, instance, "ice.density_kg_per_m3", 1090) == fmi2OK); /* heavier than the water */
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2Error);
  unit->fmi2FreeInstance(instance);
}

void check_values(const Unit* unit) {
  check_references(unit);
  check_numbers(unit);
  check_parameters(unit);
}
