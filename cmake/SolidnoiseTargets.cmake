# Settings that every target of the project shares, and one function per kind of target.

add_library(solidnoise_settings INTERFACE)
target_compile_features(solidnoise_settings INTERFACE cxx_std_20)
# Contraction would give each instruction set its own rounding; explicit multiply-adds stay.
target_compile_options(solidnoise_settings INTERFACE -ffp-contract=off)
set(_warnings -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
if(SOLIDNOISE_WARNINGS_AS_ERRORS)
  list(APPEND _warnings -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND _warnings -Wno-subobject-linkage) # files that are compiled together look like headers to it
endif()
# Tools and bindings are optimised less: what takes time is in the libraries, and a third less is spent on compiling them.
set(_light $<$<CONFIG:Release>:-O1>)

# solidnoise_compile_together(TARGET [COUNT]): compiles so many files of a target at once, two dozen by default, which parses headers and
# instantiates templates once for all of them: half the time. CMAKE_UNITY_BUILD=OFF compiles each alone.
function(solidnoise_compile_together target)
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
  endif()
  set(_count 24)
  if(ARGC GREATER 1)
    set(_count ${ARGV1})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${_count})
  # What includes itself for each instruction set stays alone.
  get_target_property(_sources ${target} SOURCES)
  list(FILTER _sources INCLUDE REGEX "_simd\\.cpp$")
  set_source_files_properties(${_sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# solidnoise_library(NAME PUBLIC ... PRIVATE ...): the library of the folder NAME, made of all the .cpp files in it and
# its folders, but for those that have a CMakeLists.txt of their own, with the libraries that its headers (PUBLIC) and
# its sources (PRIVATE) use.
function(solidnoise_library name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE _sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  file(GLOB_RECURSE _others CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*/CMakeLists.txt)
  foreach(_other IN LISTS _others)
    get_filename_component(_folder ${_other} DIRECTORY)
    list(FILTER _sources EXCLUDE REGEX "^${_folder}/")
  endforeach()
  if(NOT _sources)
    return()
  endif()
  add_library(solidnoise_${name} ${_sources})
  add_library(solidnoise::${name} ALIAS solidnoise_${name})
  set_target_properties(solidnoise_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(solidnoise_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(solidnoise_${name} PUBLIC cxx_std_20)
  target_compile_options(solidnoise_${name} PRIVATE ${_warnings} -ffp-contract=off)
  target_link_libraries(solidnoise_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  solidnoise_compile_together(solidnoise_${name})
  set_property(GLOBAL APPEND PROPERTY SOLIDNOISE_LIBRARIES solidnoise_${name})
endfunction()

# solidnoise_test(NAME LIBRARIES ...): one test program for the folder tests/NAME, without the files whose names match
# SOLIDNOISE_TESTS_LEFT_OUT, compiled with SOLIDNOISE_TEST_OPTIONS besides what all is compiled with.
set(SOLIDNOISE_TESTS_LEFT_OUT "" CACHE STRING "Files of tests that are not built: a regular expression; empty: all are built")
set(SOLIDNOISE_TEST_OPTIONS "" CACHE STRING "Further options of the compiler for files of tests")
function(solidnoise_test name)
  file(GLOB _sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(SOLIDNOISE_TESTS_LEFT_OUT)
    list(FILTER _sources EXCLUDE REGEX "${SOLIDNOISE_TESTS_LEFT_OUT}")
  endif()
  if(NOT _sources)
    return()
  endif()
  add_executable(${name}_tests ${_sources})
  target_include_directories(${name}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_options(${name}_tests PRIVATE ${_warnings} ${SOLIDNOISE_TEST_OPTIONS})
  target_link_libraries(${name}_tests PRIVATE solidnoise_settings solidnoise_test_paths ${ARGN} GTest::gtest_main)
  solidnoise_compile_together(${name}_tests)
  gtest_discover_tests(${name}_tests TEST_PREFIX "${name}/" DISCOVERY_TIMEOUT 60)
endfunction()
