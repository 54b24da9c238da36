# One function that makes a room: a static library polynya::NAME whose includes read "NAME/file.hpp".
#
#   polynya_room(geometry SOURCES a.cpp b.cpp [PUBLIC lib...] [PRIVATE lib...])

add_library(polynya_options INTERFACE)
target_compile_features(polynya_options INTERFACE cxx_std_20)
# No contraction: the same source gives the same bytes whether or not the machine has fused multiply-add.
target_compile_options(polynya_options INTERFACE -ffp-contract=off)

# For code that every step runs. Neither changes a result: square roots set no errno, and both sides of a choice may be
# computed before it. GCC clears and copies small objects by string instructions, whose start-up costs a contact 10 %.
set(POLYNYA_HOT_OPTIONS -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  list(APPEND POLYNYA_HOT_OPTIONS
    -mmemset-strategy=unrolled_loop:512:noalign,libcall:-1:noalign
    -mmemcpy-strategy=unrolled_loop:512:noalign,libcall:-1:noalign)
endif()

add_library(polynya_warnings INTERFACE)
target_compile_options(polynya_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False alarms of GCC 12 inside the standard library's strings and variants once inlined.
  target_compile_options(polynya_warnings INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
endif()

function(polynya_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target polynya_${name})
  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(polynya::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..> $<INSTALL_INTERFACE:include/polynya>)
  target_link_libraries(${target}
    PUBLIC polynya_options ${ROOM_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:polynya_warnings> ${ROOM_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY POLYNYA_ROOMS ${target})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION include/polynya/${name}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "internal" EXCLUDE)
endfunction()
