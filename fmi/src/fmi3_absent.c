/* Functions of FMI 3.0 that an FMU of ours has to have and refuses: types without variables, clocks, configuration,
 * scheduled execution. */
#include "fmi3Functions.h"
#include "fmu.h"

static fmi3Status status(bool done) {
  return done ? fmi3OK : fmi3Error;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
  (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)update, (void)lock, (void)unlock;
  if (log) log(environment, fmi3Error, "logStatusError", "this FMU has no scheduled execution");
  return NULL;
}

static fmi3Status without(fmu *f, size_t n, const char *type) {
  return n == 0 ? fmi3OK : status(fmu_refuse(f, "this FMU has no variables of type %s", type));
}

#define NO_VALUES(Name, ctype)                                                                                         \
  fmi3Status fmi3Get##Name(fmi3Instance instance, const fmi3ValueReference references[], size_t n, ctype values[],     \
                           size_t n_values) {                                                                          \
    (void)references, (void)values, (void)n_values;                                                                    \
    return without(instance, n, #Name);                                                                                \
  }                                                                                                                    \
  fmi3Status fmi3Set##Name(fmi3Instance instance, const fmi3ValueReference references[], size_t n,                     \
                           const ctype values[], size_t n_values) {                                                    \
    (void)references, (void)values, (void)n_values;                                                                    \
    return without(instance, n, #Name);                                                                                \
  }
NO_VALUES(Float32, fmi3Float32)
NO_VALUES(Int8, fmi3Int8)
NO_VALUES(UInt8, fmi3UInt8)
NO_VALUES(Int16, fmi3Int16)
NO_VALUES(UInt16, fmi3UInt16)
NO_VALUES(UInt32, fmi3UInt32)
NO_VALUES(Int64, fmi3Int64)
NO_VALUES(UInt64, fmi3UInt64)
NO_VALUES(String, fmi3String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t n, size_t sizes[],
                         fmi3Binary values[], size_t n_values) {
  (void)references, (void)sizes, (void)values, (void)n_values;
  return without(instance, n, "Binary");
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t n, const size_t sizes[],
                         const fmi3Binary values[], size_t n_values) {
  (void)references, (void)sizes, (void)values, (void)n_values;
  return without(instance, n, "Binary");
}

#define NO_CLOCKS(Name, ...)                                                                                           \
  fmi3Status Name(fmi3Instance instance, const fmi3ValueReference references[], size_t n, __VA_ARGS__) {               \
    (void)references, (void)a;                                                                                         \
    return without(instance, n, "Clock");                                                                              \
  }
#define NO_CLOCKS_2(Name, ...)                                                                                         \
  fmi3Status Name(fmi3Instance instance, const fmi3ValueReference references[], size_t n, __VA_ARGS__) {               \
    (void)references, (void)a, (void)b;                                                                                \
    return without(instance, n, "Clock");                                                                              \
  }
NO_CLOCKS(fmi3GetClock, fmi3Clock a[])
NO_CLOCKS(fmi3SetClock, const fmi3Clock a[])
NO_CLOCKS(fmi3GetShiftDecimal, fmi3Float64 a[])
NO_CLOCKS(fmi3SetShiftDecimal, const fmi3Float64 a[])
NO_CLOCKS(fmi3SetIntervalDecimal, const fmi3Float64 a[])
NO_CLOCKS_2(fmi3GetIntervalDecimal, fmi3Float64 a[], fmi3IntervalQualifier b[])
NO_CLOCKS_2(fmi3GetShiftFraction, fmi3UInt64 a[], fmi3UInt64 b[])
NO_CLOCKS_2(fmi3SetShiftFraction, const fmi3UInt64 a[], const fmi3UInt64 b[])
NO_CLOCKS_2(fmi3SetIntervalFraction, const fmi3UInt64 a[], const fmi3UInt64 b[])

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference references[], size_t n,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[]) {
  (void)references, (void)counters, (void)resolutions, (void)qualifiers;
  return without(instance, n, "Clock");
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference reference, size_t *n) {
  (void)n;
  return status(fmu_refuse(instance, "dependencies of variable %u are those of the model description", reference));
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent, size_t elements[],
                                       fmi3ValueReference independents[], size_t of_independents[],
                                       fmi3DependencyKind kinds[], size_t n) {
  (void)elements, (void)independents, (void)of_independents, (void)kinds, (void)n;
  return status(fmu_refuse(instance, "dependencies of variable %u are those of the model description", dependent));
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t n_unknowns,
                                    const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[],
                                    size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity) {
  (void)unknowns, (void)n_unknowns, (void)knowns, (void)n_knowns, (void)seed, (void)n_seed, (void)sensitivity;
  (void)n_sensitivity;
  return status(fmu_refuse(instance, "this FMU has no adjoint derivatives"));
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return status(fmu_refuse(instance, "this FMU has no structural parameters to configure"));
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return status(fmu_refuse(instance, "this FMU has no structural parameters to configure"));
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return status(fmu_refuse(instance, "this FMU gives the values of an event when it has happened"));
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference references[], size_t n,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t n_values) {
  (void)references, (void)orders, (void)values, (void)n_values;
  return n == 0 ? fmi3OK : status(fmu_refuse(instance, "this FMU has no derivatives of outputs by time"));
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 time) {
  (void)clock, (void)time;
  return status(fmu_refuse(instance, "this FMU has no scheduled execution"));
}
