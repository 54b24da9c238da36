/* A co-simulation unit as a master has it: its library, loaded by dlopen or LoadLibrary, its functions, and its
   variables by name. */
#ifndef POLYNYA_TESTS_COSIM_UNIT_H
#define POLYNYA_TESTS_COSIM_UNIT_H

#include "cosim/fmi2.h"

#define MOST_VARIABLES 600
#define LONGEST_NAME 120

typedef struct {
  char name[LONGEST_NAME];
  fmi2ValueReference reference;
  char type; /* r, i or b: real, integer or boolean */
  char kind; /* p, c, i or o: parameter, calculated parameter, input or output */
} Variable;

typedef struct {
  void* library;
  char guid[64];
  char resources[4096];
  Variable variables[MOST_VARIABLES];
  int count;
#define POLYNYA_FMI2_POINTER(result, name, parameters) name##TYPE* name;
  POLYNYA_FMI2_FUNCTIONS(POLYNYA_FMI2_POINTER)
#undef POLYNYA_FMI2_POINTER
} Unit;

/* Loads an unpacked unit from its folder, which has a file variables.txt besides (tests/cosim/unpacked.py): the guid,
   then a line a variable. Ends the program if that fails. */
void load_unit(Unit* unit, const char* folder);
/* The reference of a variable. Ends the program if there is none. */
fmi2ValueReference reference_of(const Unit* unit, const char* name);

/* What the logger of an instance was told. */
typedef struct {
  int count;
  int of_status[6];
  char last_category[64];
  char last_message[512];
} Log;

fmi2CallbackFunctions callbacks_to(Log* log);

/* An instance before initialization, or null. */
fmi2Component make(const Unit* unit, const char* name, const fmi2CallbackFunctions* callbacks);
/* The same, initialized with its start values. Ends the program if that fails. */
fmi2Component ready(const Unit* unit, const char* name, const fmi2CallbackFunctions* callbacks);

double real(const Unit* unit, fmi2Component instance, const char* name);
int integer(const Unit* unit, fmi2Component instance, const char* name);
fmi2Status set_real(const Unit* unit, fmi2Component instance, const char* name, double value);
fmi2Status set_integer(const Unit* unit, fmi2Component instance, const char* name, int value);

/* The bytes of an instance's state; the caller frees them. */
char* state_bytes(const Unit* unit, fmi2Component instance, size_t* size);

/* All that an instance is, to compare: the values of all variables, bit by bit, and the hash of the run's state, which
   covers all that decides how the run goes on (docs/reliability.md). The bytes of a state also have caches, which may
   differ where the run is the same; its hash is in the last bytes but eight. */
typedef struct {
  double values[MOST_VARIABLES];
  char hash[8];
} Picture;
void take_picture(const Unit* unit, fmi2Component instance, Picture* picture);
int are_same(const Picture* a, const Picture* b);

/* Checks. A failed one prints where it stands; failures() counts them. */
void expect(int holds, const char* what, const char* file, int line);
int failures(void);
#define EXPECT(condition) expect(condition, #condition, __FILE__, __LINE__)

/* A number from 0 to below `limit`, from a seed that moves on. */
unsigned drawn(unsigned long long* seed, unsigned limit);

#endif
