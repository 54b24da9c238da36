/* What the logger is told: errors always, other categories where they are asked for. */
#include "checks.h"
#include <string.h>

static int advance(const Unit* unit, fmi2Component instance, int from, int steps) {
  for (int i = from; i < from + steps; ++i) EXPECT(unit->fmi2DoStep(instance, 0.2 * i, 0.2, fmi2True) == fmi2OK);
  return from + steps;
}

void check_log(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(unit, "log", &callbacks);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 1) == fmi2OK);
  int at = advance(unit, instance, 0, 40);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 2) == fmi2Discard);
  EXPECT(log.count == 0); /* off */
  const fmi2String discards[] = {"logStatusDiscard"}, events[] = {"logEvents"}, unknown[] = {"logWhatever"};
  EXPECT(unit->fmi2SetDebugLogging(instance, fmi2True, 1, discards) == fmi2OK);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 2) == fmi2Discard);
  EXPECT(log.count == 1 && strcmp(log.last_category, "logStatusDiscard") == 0);
  at = advance(unit, instance, at, 40);
  EXPECT(log.count == 1); /* events are not asked for */
  EXPECT(unit->fmi2SetDebugLogging(instance, fmi2True, 1, events) == fmi2OK);
  at = advance(unit, instance, at, 60);
  EXPECT(log.count > 1 && strcmp(log.last_category, "logEvents") == 0 && strstr(log.last_message, "\"kind\""));
  const int count = log.count;
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 2) == fmi2Discard);
  EXPECT(log.count == count);
  EXPECT(unit->fmi2SetDebugLogging(instance, fmi2False, 0, NULL) == fmi2OK);
  at = advance(unit, instance, at, 40);
  EXPECT(log.count == count);
  EXPECT(unit->fmi2SetDebugLogging(instance, fmi2True, 1, unknown) == fmi2Error);
  EXPECT(log.count == count + 1 && strcmp(log.last_category, "logStatusError") == 0);
  unit->fmi2FreeInstance(instance);
}
