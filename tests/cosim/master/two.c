/* Two units, and several instances of each, in one process: by turns and on threads they do what each does alone. */
#include "checks.h"
#include <pthread.h>
#include <string.h>

enum { STEPS = 30 };

typedef struct {
  const Unit* unit;
  double lever;
  Picture end;
} Voyage;

static void take_step(const Unit* unit, fmi2Component instance, double lever, int i) {
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", lever) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 0.2 * i, 0.2, fmi2True) == fmi2OK);
}

static void* sail(void* argument) {
  Voyage* voyage = argument;
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(voyage->unit, "alone", &callbacks);
  for (int i = 0; i < STEPS; ++i) take_step(voyage->unit, instance, voyage->lever, i);
  take_picture(voyage->unit, instance, &voyage->end);
  voyage->unit->fmi2FreeInstance(instance);
  return NULL;
}

void check_two(const Unit* first, const Unit* second) {
  static Voyage alone[4];
  const Voyage voyages[4] = {{.unit = first, .lever = 1},
                             {.unit = second, .lever = 1},
                             {.unit = first, .lever = 0.5},
                             {.unit = second, .lever = 0.5}};
  static Voyage at_once[4];
  memcpy(alone, voyages, sizeof alone);
  memcpy(at_once, voyages, sizeof at_once);
  for (int i = 0; i < 4; ++i) sail(&alone[i]);
  for (int i = 1; i < 4; ++i) EXPECT(!are_same(&alone[0].end, &alone[i].end));

  pthread_t threads[4];
  for (int i = 0; i < 4; ++i) EXPECT(pthread_create(&threads[i], NULL, sail, &at_once[i]) == 0);
  for (int i = 0; i < 4; ++i) EXPECT(pthread_join(threads[i], NULL) == 0);
  for (int i = 0; i < 4; ++i) EXPECT(are_same(&alone[i].end, &at_once[i].end));

  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instances[4];
  for (int i = 0; i < 4; ++i) instances[i] = ready(alone[i].unit, "by turns", &callbacks);
  for (int step = 0; step < STEPS; ++step)
    for (int i = 0; i < 4; ++i) take_step(alone[i].unit, instances[i], alone[i].lever, step);
  for (int i = 0; i < 4; ++i) {
    Picture by_turns;
    take_picture(alone[i].unit, instances[i], &by_turns);
    EXPECT(are_same(&alone[i].end, &by_turns));
    alone[i].unit->fmi2FreeInstance(instances[i]);
  }
}
