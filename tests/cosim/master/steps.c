/* Communication steps: of any whole number of ticks, and no move of time where one fails. */
#include "checks.h"
#include <math.h>

/* A step that must be refused, and leave the instance as it was, to the bit. */
static void expect_unmoved(const Unit* unit, fmi2Component instance, double from, double length) {
  Picture before, after;
  double time = -1;
  take_picture(unit, instance, &before);
  EXPECT(unit->fmi2DoStep(instance, from, length, fmi2True) == fmi2Discard);
  EXPECT(unit->fmi2GetRealStatus(instance, fmi2LastSuccessfulTime, &time) == fmi2OK && time == from);
  take_picture(unit, instance, &after);
  EXPECT(are_same(&before, &after));
}

static void check_refused(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = make(unit, "refused", &callbacks);
  EXPECT(set_integer(unit, instance, "barge.control", 3) == fmi2OK); /* its motion is given */
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 0, 0.2, fmi2True) == fmi2OK);
  expect_unmoved(unit, instance, 0.2, 0.03);  /* one tick and a half */
  expect_unmoved(unit, instance, 0.2, 0.001); /* less than one */
  const double x = real(unit, instance, "barge.x_m");
  EXPECT(set_real(unit, instance, "barge.motion.x_m", x + 1000) == fmi2OK);
  expect_unmoved(unit, instance, 0.2, 0.1); /* a jump that no ship makes */
  EXPECT(set_real(unit, instance, "barge.motion.x_m", x) == fmi2OK);
  EXPECT(set_real(unit, instance, "icebreaker.external.surge_N", 1e12) == fmi2OK);
  expect_unmoved(unit, instance, 0.2, 1); /* a numerical failure some ticks later */
  EXPECT(set_real(unit, instance, "icebreaker.external.surge_N", 0) == fmi2OK);
  EXPECT(unit->fmi2DoStep(instance, 0.2, 0.1, fmi2True) == fmi2OK); /* it goes on */

  EXPECT(unit->fmi2DoStep(instance, 0.2, 0.1, fmi2True) == fmi2Error); /* not where it is */
  unit->fmi2FreeInstance(instance);
  instance = ready(unit, "refused", &callbacks);
  EXPECT(unit->fmi2DoStep(instance, 0, -0.1, fmi2True) == fmi2Error);
  unit->fmi2FreeInstance(instance);
  instance = ready(unit, "refused", &callbacks);
  EXPECT(unit->fmi2DoStep(instance, 0, NAN, fmi2True) == fmi2Error);
  unit->fmi2FreeInstance(instance);
}

/* Where a ship is after 4 s in steps of so many ticks does not depend on them. */
static double place_after(const Unit* unit, int ticks) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = ready(unit, "cut", &callbacks);
  EXPECT(set_real(unit, instance, "icebreaker.command.lever", 1) == fmi2OK);
  for (int done = 0; done < 200; done += ticks)
    EXPECT(unit->fmi2DoStep(instance, done * TICK, ticks * TICK, fmi2True) == fmi2OK);
  const double x = real(unit, instance, "icebreaker.x_m");
  unit->fmi2FreeInstance(instance);
  return x;
}

/* A ship whose motion is given is where it is said to be at the end of each step. */
static void check_motion(const Unit* unit) {
  Log log;
  const fmi2CallbackFunctions callbacks = callbacks_to(&log);
  fmi2Component instance = make(unit, "motion", &callbacks);
  EXPECT(set_integer(unit, instance, "icebreaker.control", 3) == fmi2OK);
  EXPECT(unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
  EXPECT(unit->fmi2EnterInitializationMode(instance) == fmi2OK);
  EXPECT(unit->fmi2ExitInitializationMode(instance) == fmi2OK);
  double x = real(unit, instance, "icebreaker.x_m"), heading = 0, ice = 0;
  for (int i = 0; i < 60; ++i) {
    const double speed = 3 + 0.5 * sin(0.1 * i), turning = 0.01 * cos(0.2 * i);
    EXPECT(set_real(unit, instance, "icebreaker.motion.x_m", x) == fmi2OK);
    EXPECT(set_real(unit, instance, "icebreaker.motion.heading_rad", heading) == fmi2OK);
    EXPECT(set_real(unit, instance, "icebreaker.motion.vx_m_per_s", speed) == fmi2OK);
    EXPECT(set_real(unit, instance, "icebreaker.motion.yaw_rate_rad_per_s", turning) == fmi2OK);
    EXPECT(unit->fmi2DoStep(instance, 0.2 * i, 0.2, fmi2True) == fmi2OK);
    x += 0.2 * speed;
    heading += 0.2 * turning;
    EXPECT(fabs(real(unit, instance, "icebreaker.x_m") - x) < 1e-9);
    EXPECT(fabs(real(unit, instance, "icebreaker.heading_rad") - heading) < 1e-12);
    ice = fmin(ice, real(unit, instance, "icebreaker.ice.surge_N"));
  }
  EXPECT(ice < -1e3); /* the ice resists */
  EXPECT(real(unit, instance, "icebreaker.engine.surge_N") == 0);
  unit->fmi2FreeInstance(instance);
}

void check_steps(const Unit* unit) {
  check_refused(unit);
  const double one = place_after(unit, 1);
  EXPECT(one > START_X + 5);
  EXPECT(one == place_after(unit, 4) && one == place_after(unit, 25) && one == place_after(unit, 200));
  check_motion(unit);
}
