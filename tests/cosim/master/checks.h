/* The checks of the master, each of which takes loaded units and counts what fails (EXPECT of unit.h). */
#ifndef POLYNYA_TESTS_COSIM_CHECKS_H
#define POLYNYA_TESTS_COSIM_CHECKS_H

#include "unit.h"

#define START_X (-40.0) /* where tests/cosim/coupled.json has its icebreaker at the start [m] */
#define TICK 0.02       /* of that scene [s] */

void check_calls(const Unit* unit);
void check_values(const Unit* unit);
void check_steps(const Unit* unit);
void check_log(const Unit* unit);
void check_rollback(const Unit* unit);
void check_two(const Unit* first, const Unit* second);
void check_course(const Unit* unit, const char* path, const char* state);

#endif
