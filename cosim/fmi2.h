/* The public interface of the Functional Mock-up Interface 2.0 for co-simulation, declared from its specification:
   types, callbacks and functions that a unit has and that a master finds by name. For C and C++. */
#ifndef POLYNYA_COSIM_FMI2_H
#define POLYNYA_COSIM_FMI2_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define fmi2TypesPlatform "default"
#define fmi2Version "2.0"
#define fmi2True 1
#define fmi2False 0

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct {
  void (*logger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category, fmi2String message,
                 ...);
  void* (*allocateMemory)(size_t count, size_t size);
  void (*freeMemory)(void*);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

/* Each function of a unit by its parameters, from which both a declaration and a pointer's type are made. */
#define POLYNYA_FMI2_FUNCTIONS(FUNCTION)                                                                             \
  FUNCTION(const char*, fmi2GetTypesPlatform, (void))                                                                \
  FUNCTION(const char*, fmi2GetVersion, (void))                                                                      \
  FUNCTION(fmi2Status, fmi2SetDebugLogging, (fmi2Component, fmi2Boolean, size_t, const fmi2String[]))                \
  FUNCTION(fmi2Component, fmi2Instantiate,                                                                           \
           (fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*, fmi2Boolean, fmi2Boolean))   \
  FUNCTION(void, fmi2FreeInstance, (fmi2Component))                                                                  \
  FUNCTION(fmi2Status, fmi2SetupExperiment, (fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real)) \
  FUNCTION(fmi2Status, fmi2EnterInitializationMode, (fmi2Component))                                                 \
  FUNCTION(fmi2Status, fmi2ExitInitializationMode, (fmi2Component))                                                  \
  FUNCTION(fmi2Status, fmi2Terminate, (fmi2Component))                                                               \
  FUNCTION(fmi2Status, fmi2Reset, (fmi2Component))                                                                   \
  FUNCTION(fmi2Status, fmi2GetReal, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]))                 \
  FUNCTION(fmi2Status, fmi2GetInteger, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]))           \
  FUNCTION(fmi2Status, fmi2GetBoolean, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]))           \
  FUNCTION(fmi2Status, fmi2GetString, (fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]))             \
  FUNCTION(fmi2Status, fmi2SetReal, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]))           \
  FUNCTION(fmi2Status, fmi2SetInteger, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[]))     \
  FUNCTION(fmi2Status, fmi2SetBoolean, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]))     \
  FUNCTION(fmi2Status, fmi2SetString, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]))       \
  FUNCTION(fmi2Status, fmi2GetFMUstate, (fmi2Component, fmi2FMUstate*))                                              \
  FUNCTION(fmi2Status, fmi2SetFMUstate, (fmi2Component, fmi2FMUstate))                                               \
  FUNCTION(fmi2Status, fmi2FreeFMUstate, (fmi2Component, fmi2FMUstate*))                                             \
  FUNCTION(fmi2Status, fmi2SerializedFMUstateSize, (fmi2Component, fmi2FMUstate, size_t*))                           \
  FUNCTION(fmi2Status, fmi2SerializeFMUstate, (fmi2Component, fmi2FMUstate, fmi2Byte[], size_t))                     \
  FUNCTION(fmi2Status, fmi2DeSerializeFMUstate, (fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate*))            \
  FUNCTION(fmi2Status, fmi2GetDirectionalDerivative,                                                                 \
           (fmi2Component, const fmi2ValueReference[], size_t, const fmi2ValueReference[], size_t, const fmi2Real[], \
            fmi2Real[]))                                                                                             \
  FUNCTION(fmi2Status, fmi2SetRealInputDerivatives,                                                                  \
           (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], const fmi2Real[]))               \
  FUNCTION(fmi2Status, fmi2GetRealOutputDerivatives,                                                                 \
           (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], fmi2Real[]))                     \
  FUNCTION(fmi2Status, fmi2DoStep, (fmi2Component, fmi2Real, fmi2Real, fmi2Boolean))                                 \
  FUNCTION(fmi2Status, fmi2CancelStep, (fmi2Component))                                                              \
  FUNCTION(fmi2Status, fmi2GetStatus, (fmi2Component, fmi2StatusKind, fmi2Status*))                                  \
  FUNCTION(fmi2Status, fmi2GetRealStatus, (fmi2Component, fmi2StatusKind, fmi2Real*))                                \
  FUNCTION(fmi2Status, fmi2GetIntegerStatus, (fmi2Component, fmi2StatusKind, fmi2Integer*))                          \
  FUNCTION(fmi2Status, fmi2GetBooleanStatus, (fmi2Component, fmi2StatusKind, fmi2Boolean*))                          \
  FUNCTION(fmi2Status, fmi2GetStringStatus, (fmi2Component, fmi2StatusKind, fmi2String*))

#define POLYNYA_FMI2_TYPE(result, name, parameters) typedef result name##TYPE parameters;
POLYNYA_FMI2_FUNCTIONS(POLYNYA_FMI2_TYPE)
#undef POLYNYA_FMI2_TYPE

#define POLYNYA_FMI2_DECLARATION(result, name, parameters) result name parameters;
POLYNYA_FMI2_FUNCTIONS(POLYNYA_FMI2_DECLARATION)
#undef POLYNYA_FMI2_DECLARATION

#ifdef __cplusplus
}
#endif

#endif
