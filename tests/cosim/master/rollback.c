/* Rollback: from any earlier state, and in another instance, the same inputs give the same values, bit by bit, and a
   state of the same hash. */
#include "checks.h"
#include <stdlib.h>
#include <string.h>

enum { STEPS = 150, INSTANTS = 100, MOST_ON = 4 };

typedef struct {
  int ticks[STEPS];
  double lever[STEPS], force[STEPS];
  double begins[STEPS + 1];
  char* bytes[STEPS + 1];
  size_t size[STEPS + 1];
  Picture pictures[STEPS + 1];
} Course;

static void take_step(const Unit* unit, fmi2Component instance, const Course* course, int i) {
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", course->lever[i]) == fmi2OK);
  EXPECT(set_real(unit, instance, "barge.external.surge_N", course->force[i]) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, course->begins[i], course->ticks[i] * TICK, fmi2True) == fmi2OK);
}

static void sail(const Unit* unit, fmi2Component instance, Course* course) {
  unsigned long long seed = 64;
  int ticks = 0;
  for (int i = 0; i < STEPS; ++i) {
    course->ticks[i] = 1 + (int)drawn(&seed, 12);
    course->lever[i] = 1e-3 * drawn(&seed, 1000);
    course->force[i] = 100.0 * drawn(&seed, 1000);
    course->begins[i] = ticks * TICK;
    course->bytes[i] = state_bytes(unit, instance, &course->size[i]);
    take_picture(unit, instance, &course->pictures[i]);
    take_step(unit, instance, course, i);
    ticks += course->ticks[i];
  }
  course->begins[STEPS] = ticks * TICK;
  course->bytes[STEPS] = state_bytes(unit, instance, &course->size[STEPS]);
  take_picture(unit, instance, &course->pictures[STEPS]);
}

static void expect_there(const Unit* unit, fmi2Component instance, const Course* course, int i) {
  Picture picture;
  take_picture(unit, instance, &picture);
  EXPECT(are_same(&picture, &course->pictures[i]));
}

static void go_back(const Unit* unit, fmi2Component instance, const Course* course, int from, int steps) {
  fmi2FMUstate state = NULL;
  EXPECT(unit->fmi2DeSerializeFMUstate(instance, course->bytes[from], course->size[from], &state) == fmi2OK);
  EXPECT(unit->fmi2SetFMUstate(instance, state) == fmi2OK);
  EXPECT(unit->fmi2FreeFMUstate(instance, &state) == fmi2OK);
  expect_there(unit, instance, course, from);
  for (int i = from; i < from + steps; ++i) {
    take_step(unit, instance, course, i);
    expect_there(unit, instance, course, i + 1);
  }
}

/* States that are none, or not whole, are refused; a good one brings the instance back from the error. */
static void check_damaged(const Unit* unit, fmi2Component instance, const Course* course) {
  fmi2FMUstate state = NULL, good = NULL;
  EXPECT(unit->fmi2GetFMUstate(instance, &good) == fmi2OK);
  unsigned long long seed = 7;
  for (int i = 0; i < 20; ++i) {
    char* bytes = malloc(course->size[9]);
    memcpy(bytes, course->bytes[9], course->size[9]);
    size_t size = course->size[9];
    if (i % 2 == 0)
      bytes[drawn(&seed, (unsigned)size)] ^= 4;
    else
      size = drawn(&seed, (unsigned)size);
    EXPECT(unit->fmi2DeSerializeFMUstate(instance, bytes, size, &state) == fmi2OK);
    EXPECT(unit->fmi2SetFMUstate(instance, state) == fmi2Error);
    EXPECT(unit->fmi2FreeFMUstate(instance, &state) == fmi2OK);
    EXPECT(unit->fmi2SetFMUstate(instance, good) == fmi2OK);
    free(bytes);
  }
  EXPECT(unit->fmi2SetFMUstate(instance, NULL) == fmi2Error);
  EXPECT(unit->fmi2SetFMUstate(instance, good) == fmi2OK);
  EXPECT(unit->fmi2FreeFMUstate(instance, &good) == fmi2OK);
  EXPECT(unit->fmi2FreeFMUstate(instance, &good) == fmi2OK); /* null: nothing to do */
}

void check_rollback(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component first = ready(unit, "first", &callbacks), second = ready(unit, "second", &callbacks);
  static Course course;
  sail(unit, first, &course);
  EXPECT(integer(unit, first, "bends") > 0); /* ice broke on the way */
  unsigned long long seed = 65;
  for (int i = 0; i < INSTANTS; ++i) {
    const int from = (int)drawn(&seed, STEPS - MOST_ON);
    go_back(unit, i % 2 == 0 ? first : second, &course, from, 1 + (int)drawn(&seed, MOST_ON));
  }
  fmi2Component fresh = make(unit, "fresh", &callbacks); /* from a state of another instance, without initialization */
  go_back(unit, fresh, &course, STEPS - 3, 3);
  check_damaged(unit, first, &course);
  unit->fmi2FreeInstance(first);
  unit->fmi2FreeInstance(second);
  unit->fmi2FreeInstance(fresh);
  for (int i = 0; i <= STEPS; ++i) free(course.bytes[i]);
}
