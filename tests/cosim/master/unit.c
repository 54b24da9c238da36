#include "unit.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define LIBRARY "binaries/win64/polynya.dll"
#define URI "file:///" /* before C:/folder */
#else
#include <dlfcn.h>
#define LIBRARY "binaries/linux64/polynya.so"
#define URI "file://" /* before /folder */
#endif

static _Noreturn void stop(const char* what, const char* more) {
  fprintf(stderr, "master: %s %s\n", what, more);
  exit(2);
}

static void read_variables(Unit* unit, const char* folder) {
  char path[4200], line[512];
  snprintf(path, sizeof path, "%s/variables.txt", folder);
  FILE* file = fopen(path, "r");
  if (!file || !fgets(line, sizeof line, file)) stop("cannot read", path);
  snprintf(unit->guid, sizeof unit->guid, "%.*s", (int)strcspn(line, "\n"), line);
  while (unit->count < MOST_VARIABLES && fgets(line, sizeof line, file)) {
    Variable* v = &unit->variables[unit->count++];
    if (sscanf(line, "%u %c %c %119[^\n]", &v->reference, &v->type, &v->kind, v->name) != 4) stop("cannot read", line);
  }
  fclose(file);
}

#ifdef _WIN32
static void open_library(Unit* unit, const char* path) {
  unit->library = LoadLibraryA(path);
  if (!unit->library) stop("LoadLibrary fails:", path);
}
static void* find_function(const Unit* unit, const char* name) {
  return (void*)GetProcAddress(unit->library, name);
}
#else
static void open_library(Unit* unit, const char* path) {
  unit->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!unit->library) stop("dlopen:", dlerror());
}
static void* find_function(const Unit* unit, const char* name) {
  return dlsym(unit->library, name);
}
#endif

void load_unit(Unit* unit, const char* folder) {
  char path[4200];
  memset(unit, 0, sizeof *unit);
  read_variables(unit, folder);
  snprintf(unit->resources, sizeof unit->resources, URI "%s/resources", folder);
  snprintf(path, sizeof path, "%s/" LIBRARY, folder);
  open_library(unit, path);
#define POLYNYA_FMI2_FIND(result, name, parameters)    \
  *(void**)(&unit->name) = find_function(unit, #name); \
  if (!unit->name) stop("the library has no function", #name);
  POLYNYA_FMI2_FUNCTIONS(POLYNYA_FMI2_FIND)
#undef POLYNYA_FMI2_FIND
}

fmi2ValueReference reference_of(const Unit* unit, const char* name) {
  for (int i = 0; i < unit->count; ++i)
    if (strcmp(unit->variables[i].name, name) == 0) return unit->variables[i].reference;
  stop("no variable", name);
}

static void take(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                 fmi2String message, ...) {
  Log* log = environment;
  va_list arguments;
  (void)instance;
  va_start(arguments, message);
  vsnprintf(log->last_message, sizeof log->last_message, message, arguments);
  va_end(arguments);
  snprintf(log->last_category, sizeof log->last_category, "%s", category);
  ++log->count;
  ++log->of_status[status];
}

fmi2CallbackFunctions callbacks_to(Log* log) {
  fmi2CallbackFunctions callbacks = {take, calloc, free, NULL, log};
  memset(log, 0, sizeof *log);
  return callbacks;
}

fmi2Component make(const Unit* unit, const char* name, const fmi2CallbackFunctions* callbacks) {
  return unit->fmi2Instantiate(name, fmi2CoSimulation, unit->guid, unit->resources, callbacks, fmi2False, fmi2False);
}

fmi2Component ready(const Unit* unit, const char* name, const fmi2CallbackFunctions* callbacks) {
  fmi2Component instance = make(unit, name, callbacks);
  if (!instance) stop("no instance", name);
  if (unit->fmi2SetupExperiment(instance, fmi2False, 0, 0, fmi2False, 0) != fmi2OK ||
      unit->fmi2EnterInitializationMode(instance) != fmi2OK || unit->fmi2ExitInitializationMode(instance) != fmi2OK)
    stop("cannot initialize", name);
  return instance;
}

double real(const Unit* unit, fmi2Component instance, const char* name) {
  const fmi2ValueReference reference = reference_of(unit, name);
  double value = 0;
  EXPECT(unit->fmi2GetReal(instance, &reference, 1, &value) == fmi2OK);
  return value;
}

int integer(const Unit* unit, fmi2Component instance, const char* name) {
  const fmi2ValueReference reference = reference_of(unit, name);
  int value = 0;
  EXPECT(unit->fmi2GetInteger(instance, &reference, 1, &value) == fmi2OK);
  return value;
}

fmi2Status set_real(const Unit* unit, fmi2Component instance, const char* name, double value) {
  const fmi2ValueReference reference = reference_of(unit, name);
  return unit->fmi2SetReal(instance, &reference, 1, &value);
}

fmi2Status set_integer(const Unit* unit, fmi2Component instance, const char* name, int value) {
  const fmi2ValueReference reference = reference_of(unit, name);
  return unit->fmi2SetInteger(instance, &reference, 1, &value);
}

char* state_bytes(const Unit* unit, fmi2Component instance, size_t* size) {
  fmi2FMUstate state = NULL;
  EXPECT(unit->fmi2GetFMUstate(instance, &state) == fmi2OK);
  EXPECT(unit->fmi2SerializedFMUstateSize(instance, state, size) == fmi2OK);
  char* bytes = malloc(*size);
  EXPECT(unit->fmi2SerializeFMUstate(instance, state, bytes, *size) == fmi2OK);
  EXPECT(unit->fmi2FreeFMUstate(instance, &state) == fmi2OK);
  EXPECT(state == NULL);
  return bytes;
}

static double value_of(const Unit* unit, fmi2Component instance, const Variable* v) {
  double number = 0;
  int whole = 0;
  if (v->type == 'r') EXPECT(unit->fmi2GetReal(instance, &v->reference, 1, &number) == fmi2OK);
  if (v->type == 'i') EXPECT(unit->fmi2GetInteger(instance, &v->reference, 1, &whole) == fmi2OK);
  if (v->type == 'b') EXPECT(unit->fmi2GetBoolean(instance, &v->reference, 1, &whole) == fmi2OK);
  return v->type == 'r' ? number : whole;
}

void take_picture(const Unit* unit, fmi2Component instance, Picture* picture) {
  size_t size = 0;
  char* bytes = state_bytes(unit, instance, &size);
  memset(picture, 0, sizeof *picture);
  memcpy(picture->hash, bytes + size - 16, sizeof picture->hash);
  free(bytes);
  for (int i = 0; i < unit->count; ++i) picture->values[i] = value_of(unit, instance, &unit->variables[i]);
}

int are_same(const Picture* a, const Picture* b) {
  return memcmp(a, b, sizeof *a) == 0;
}

static atomic_int failed;

void expect(int holds, const char* what, const char* file, int line) {
  if (holds) return;
  fprintf(stderr, "%s:%d: failed: %s\n", file, line, what);
  ++failed;
}

int failures(void) {
  return failed;
}

unsigned drawn(unsigned long long* seed, unsigned limit) {
  *seed = *seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (unsigned)(*seed >> 33) % limit;
}
