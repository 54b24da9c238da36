/* The order of calls, and what is wrong with calls: each gives the status that the standard has for it. */
#include "checks.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void check_making(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  EXPECT(strcmp(unit->fmi2GetTypesPlatform(), "default") == 0);
  EXPECT(strcmp(unit->fmi2GetVersion(), "2.0") == 0);
  EXPECT(!unit->fmi2Instantiate("a", fmi2CoSimulation, "{wrong}", unit->resources, &callbacks, 0, 0));
  EXPECT(log.of_status[fmi2Error] == 1 && strstr(log.last_message, "guid"));
  EXPECT(!unit->fmi2Instantiate("a", fmi2ModelExchange, unit->guid, unit->resources, &callbacks, 0, 0));
  EXPECT(!unit->fmi2Instantiate("", fmi2CoSimulation, unit->guid, unit->resources, &callbacks, 0, 0));
  EXPECT(!unit->fmi2Instantiate("a", fmi2CoSimulation, unit->guid, "http://a/b", &callbacks, 0, 0));
  EXPECT(!unit->fmi2Instantiate("a", fmi2CoSimulation, unit->guid, "file:///nowhere", &callbacks, 0, 0));
  EXPECT(!unit->fmi2Instantiate("a", fmi2CoSimulation, unit->guid, NULL, &callbacks, 0, 0));
  EXPECT(!unit->fmi2Instantiate("a", fmi2CoSimulation, unit->guid, unit->resources, NULL, 0, 0));
  EXPECT(log.of_status[fmi2Error] == 6);
  unit->fmi2FreeInstance(NULL);
}

/* After an error the instance takes a reset, and no step, until then. */
static void expect_reset(const Unit* unit, fmi2Component instance) {
  EXPECT(unit->fmi2DoStep(instance, 0, 0.1, fmi2True) == fmi2Error);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2Error);
  EXPECT(unit->fmi2Reset(instance) == fmi2OK);
}

static void check_order(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = make(unit, "order", &callbacks);
  const fmi2ValueReference output = reference_of(unit, "icebreaker.x_m");
  double value = 0;
  EXPECT(unit->fmi2DoStep(instance, 0, 0.1, fmi2True) == fmi2Error);
  expect_reset(unit, instance);
  EXPECT(unit->fmi2GetReal(instance, &output, 1, &value) == fmi2Error);
  expect_reset(unit, instance);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2Error);
  expect_reset(unit, instance);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2Error); /* before fmi2SetupExperiment */
  expect_reset(unit, instance);
  EXPECT(unit->fmi2Terminate(instance) == fmi2Error);
  expect_reset(unit, instance);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, NAN, fmi2False, 0) == fmi2Error);
  expect_reset(unit, instance);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 5, fmi2True, 4) == fmi2Error);
  expect_reset(unit, instance);

  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 7, fmi2True, 8) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 7, fmi2True, 8) == fmi2Error);
  expect_reset(unit, instance);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 7, fmi2True, 8) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2GetReal(instance, &output, 1, &value) == fmi2OK);
  EXPECT(value == START_X);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 7, 0.5, fmi2True) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 7.5, 0.6, fmi2True) == fmi2Error); /* past the stop time */
  EXPECT(log.of_status[fmi2Error] > 0 && strstr(log.last_message, "stop time"));
  expect_reset(unit, instance);
  unit->fmi2FreeInstance(instance);
}

static void check_end(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(unit, "end", &callbacks);
  EXPECT(unit->fmi2DoStep(instance, 0, 0.5, fmi2True) == fmi2OK);
  const double first = real(unit, instance, "icebreaker.x_m");
  EXPECT(unit->fmi2Terminate(instance) == fmi2OK);
  EXPECT(real(unit, instance, "icebreaker.x_m") == first);
  EXPECT(unit->fmi2DoStep(instance, 0.5, 0.5, fmi2True) == fmi2Error);
  EXPECT(real(unit, instance, "icebreaker.x_m") == first); /* values stay readable after an error */
  EXPECT(unit->fmi2Reset(instance) == fmi2OK);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 0, 0.5, fmi2True) == fmi2OK);
  EXPECT(real(unit, instance, "icebreaker.x_m") == first); /* a reset instance does the same again */
  unit->fmi2FreeInstance(instance);
}

static void check_unsupported(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  const fmi2ValueReference reference = reference_of(unit, "icebreaker.x_m");
  const int order = 1;
  double number = 1;
  int status = 0;
  fmi2Status step = fmi2OK;
  fmi2String text = NULL;
  fmi2Component instance = ready(unit, "unsupported", &callbacks);
  EXPECT(unit->fmi2GetStatus(instance, fmi2DoStepStatus, &step) == fmi2Discard);
  EXPECT(unit->fmi2GetIntegerStatus(instance, fmi2DoStepStatus, &status) == fmi2Discard);
  EXPECT(unit->fmi2GetStringStatus(instance, fmi2PendingStatus, &text) == fmi2Discard);
  EXPECT(unit->fmi2GetRealStatus(instance, fmi2DoStepStatus, &number) == fmi2Discard);
  EXPECT(unit->fmi2GetBooleanStatus(instance, fmi2Terminated, &status) == fmi2OK && status == fmi2False);
  EXPECT(unit->fmi2CancelStep(instance) == fmi2Error);
  unit->fmi2FreeInstance(instance);
  instance = ready(unit, "unsupported", &callbacks);
  EXPECT(unit->fmi2GetDirectionalDerivative(instance, &reference, 1, &reference, 1, &number, &number) == fmi2Error);
  unit->fmi2FreeInstance(instance);
  instance = ready(unit, "unsupported", &callbacks);
  EXPECT(unit->fmi2SetRealInputDerivatives(instance, &reference, 1, &order, &number) == fmi2Error);
  unit->fmi2FreeInstance(instance);
  instance = ready(unit, "unsupported", &callbacks);
  EXPECT(unit->fmi2GetRealOutputDerivatives(instance, &reference, 1, &order, &number) == fmi2Error);
  unit->fmi2FreeInstance(instance);
}

void check_calls(const Unit* unit) {
  check_making(unit);
  check_order(unit);
  check_end(unit);
  check_unsupported(unit);
}
