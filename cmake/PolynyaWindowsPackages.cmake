# The packages of the native build, for the co-simulation unit's library for Windows. Exact numbers are computed as in
# the browser build. cosim/windows replaces the sources that use POSIX.
set(POLYNYA_OVERRIDES ${PROJECT_SOURCE_DIR}/cosim/windows ${PROJECT_SOURCE_DIR}/browser/platform/overrides)
include_directories(BEFORE ${POLYNYA_OVERRIDES})
include(PolynyaHeaderPackages)
add_compile_definitions(NOMINMAX WIN32_LEAN_AND_MEAN)
find_package(Threads REQUIRED)
