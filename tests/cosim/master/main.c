/* Checks co-simulation units as a master would use them:
       master CHECK FOLDER [FOLDER]
       master course FOLDER FILE [STATE]
   with the folder of an unpacked unit (tests/cosim/unpacked.py), for `two` of two. */
#include "checks.h"
#include <stdio.h>
#include <string.h>

static Unit units[2];

int main(int count, char** words) {
  if (count < 3 || count > 5) return 2;
  const char* check = words[1];
  const int is_course = strcmp(check, "course") == 0;
  if (!is_course && count > 4) return 2;
  for (int i = 2; i < (is_course ? 3 : count); ++i) load_unit(&units[i - 2], words[i]);
  if (strcmp(check, "calls") == 0)
    check_calls(&units[0]);
  else if (strcmp(check, "values") == 0)
    check_values(&units[0]);
  else if (strcmp(check, "steps") == 0)
    check_steps(&units[0]);
  else if (strcmp(check, "log") == 0)
    check_log(&units[0]);
  else if (strcmp(check, "rollback") == 0)
    check_rollback(&units[0]);
  else if (is_course && count > 3)
    check_course(&units[0], words[3], count == 5 ? words[4] : NULL);
  else if (strcmp(check, "two") == 0 && count == 4)
    check_two(&units[0], &units[1]);
  else
    return 2;
  printf("%s: %d failures\n", check, failures());
  return failures() == 0 ? 0 : 1;
}
