/* The course of a run as a file, to compare a unit on one system with the same unit on another: all values, bit by bit,
   and the hash of the run's state after each step. Half way it stores the state, from which another may go on. */
#include "checks.h"
#include <stdio.h>
#include <stdlib.h>

enum { STEPS = 120, HALF = 60 };

static void write_bytes(const char* path, const void* bytes, size_t size) {
  FILE* file = fopen(path, "wb");
  EXPECT(file && fwrite(bytes, 1, size, file) == size);
  if (file) fclose(file);
}

static void store_state(const Unit* unit, fmi2Component instance, const char* path) {
  size_t size = 0;
  char name[4200];
  char* bytes = state_bytes(unit, instance, &size);
  snprintf(name, sizeof name, "%s.state", path);
  write_bytes(name, bytes, size);
  free(bytes);
}

static void restore_state(const Unit* unit, fmi2Component instance, const char* path) {
  static char bytes[1 << 24];
  FILE* file = fopen(path, "rb");
  EXPECT(file != NULL);
  if (!file) return;
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  fmi2FMUstate state = NULL;
  EXPECT(unit->fmi2DeSerializeFMUstate(instance, bytes, size, &state) == fmi2OK);
  EXPECT(unit->fmi2SetFMUstate(instance, state) == fmi2OK);
  EXPECT(unit->fmi2FreeFMUstate(instance, &state) == fmi2OK);
}

/* The file has STEPS pictures; those before the state that the run began from are 0. */
void check_course(const Unit* unit, const char* path, const char* state) {
  static Picture pictures[STEPS];
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(unit, "course", &callbacks);
  if (state) restore_state(unit, instance, state);
  unsigned long long seed = 64;
  int ticks = 0;
  for (int i = 0; i < STEPS; ++i) {
    const int length = 1 + (int)drawn(&seed, 12);
    const double lever = 1e-3 * drawn(&seed, 1000), force = 100.0 * drawn(&seed, 1000);
    if (i == HALF && !state) store_state(unit, instance, path);
    if (i >= HALF || !state) {
      EXPECT(set_real(unit, instance, "icebreaker.command.lever", lever) == fmi2OK);
      EXPECT(set_real(unit, instance, "barge.external.surge_N", force) == fmi2OK);
      EXPECT(unit->fmi2DoStep(instance, ticks * TICK, length * TICK, fmi2True) == fmi2OK);
      take_picture(unit, instance, &pictures[i]);
    }
    ticks += length;
  }
  EXPECT(integer(unit, instance, "bends") > 0); /* ice broke on the way */
  write_bytes(path, pictures, sizeof pictures);
  unit->fmi2FreeInstance(instance);
}
