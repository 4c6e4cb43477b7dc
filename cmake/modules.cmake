# Compile options of all targets: strict warnings, and the engine's folder as include root.
add_library(sigs_flags INTERFACE)
target_include_directories(sigs_flags INTERFACE "$<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/engine>" $<INSTALL_INTERFACE:include/sigs>)
target_include_directories(sigs_flags SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow -Wnon-virtual-dtor
  # Designated initialisers may leave fields at their defaults.
  -Wno-missing-field-initializers)
target_compile_options(sigs_flags INTERFACE "$<BUILD_INTERFACE:${warnings}>")
target_compile_features(sigs_flags INTERFACE cxx_std_20)
# The same sum in the same order everywhere: a fused multiply-add on one machine alone would change the bytes.
target_compile_options(sigs_flags INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
# Messages of failed checks name sources relative to the root: a program that is installed knows nothing of where it was
# built.
target_compile_options(sigs_flags INTERFACE "$<BUILD_INTERFACE:-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=>")
# GCC 12 takes members of a returned or moved std::string for unset where it has inlined much; whether it does changes with
# the sources that a unity build puts together. In CI, where warnings are errors, this one stays a warning.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(sigs_flags INTERFACE "$<BUILD_INTERFACE:-Wno-error=maybe-uninitialized>")
endif()
target_link_libraries(sigs_flags INTERFACE glm::glm tl::expected)

# The engine is linked into programs and into the Python module, a shared library. As its symbols are hidden, the code
# is as fast as that of programs alone.
set(sigs_option_shared -fPIC -fvisibility=hidden -fvisibility-inlines-hidden)

# How much a target is optimised in a release build. Nine tenths of the sources do not appear in any profile; for them
# and for the tests the time to compile counts.
set(sigs_option_fast ${sigs_option_shared})
set(sigs_option_light ${sigs_option_shared} $<$<CONFIG:Release>:-O1>)
set(sigs_option_test $<$<CONFIG:Release,Coverage,Sanitized>:-O0>)

# Headers of others that nearly every source reads are compiled once for each of the three. GCC uses them only where
# the options are the same.
if(SIGS_PRECOMPILE)
  foreach(kind fast light test)
    set(headers "${CMAKE_SOURCE_DIR}/cmake/precompiled.h")
    if(kind STREQUAL test)
      list(APPEND headers <doctest/doctest.h>)
    endif()
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp" CONTENT "")
    add_library(sigs_precompiled_${kind} OBJECT EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp")
    target_link_libraries(sigs_precompiled_${kind} PRIVATE sigs_flags)
    target_compile_options(sigs_precompiled_${kind} PRIVATE ${sigs_option_${kind}})
    target_precompile_headers(sigs_precompiled_${kind} PRIVATE ${headers})
  endforeach()
endif()

# sigs_compile(TARGET fast|light|test): optimised so, with precompiled headers, several sources at a time.
function(sigs_compile target kind)
  target_compile_options(${target} PRIVATE ${sigs_option_${kind}})
  if(SIGS_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM sigs_precompiled_${kind})
  endif()
  if(SIGS_UNITY STREQUAL "ON" OR target IN_LIST SIGS_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 24)
  endif()
endfunction()

# sigs_module(NAME [LIGHT] LINKS other libraries [PRIVATE_LINKS ...] [SOURCES made by the build]): the static library
# sigs_NAME of all .cpp of this folder and of the folders in it but main.cpp.
function(sigs_module name)
  cmake_parse_arguments(MODULE "LIGHT" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  add_library(sigs_${name} STATIC ${sources} ${MODULE_SOURCES})
  target_link_libraries(sigs_${name} PUBLIC sigs_flags ${MODULE_LINKS} PRIVATE ${MODULE_PRIVATE_LINKS})
  if(MODULE_LIGHT)
    sigs_compile(sigs_${name} light)
  else()
    sigs_compile(sigs_${name} fast)
  endif()
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/engine/")
    set_property(GLOBAL APPEND PROPERTY sigs_engine_modules sigs_${name})
  endif()
endfunction()

# sigs_test(NAME [SOURCES a_test.cpp ...] [ALSO files of other folders] LINKS libraries [LONG a_test ...]
# [TIMEOUT seconds]): one doctest program of the sources given, or of all .cpp of this folder. ctest runs it once for each
# source with test cases, as "NAME: a": with a process for each case the start would take longer than the test. A failure
# is named by its test case. Sources named LONG begin first, so that none runs alone at the end. A source whose
# cases have to be left out counts as skipped (tests/support/test_data.h).
function(sigs_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT" "SOURCES;ALSO;LINKS;LONG" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 600)
  endif()
  if(NOT TEST_SOURCES)
    file(GLOB TEST_SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  endif()
  add_executable(test_${name} ${TEST_SOURCES} ${TEST_ALSO})
  target_link_libraries(test_${name} PRIVATE sigs_test_support ${TEST_LINKS})
  sigs_compile(test_${name} test)
  foreach(source ${TEST_SOURCES})
    cmake_path(ABSOLUTE_PATH source NORMALIZE OUTPUT_VARIABLE file)
    cmake_path(GET file STEM stem)
    if(NOT stem MATCHES "_test$")
      # Some files of test cases have other names.
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
      file(STRINGS "${file}" cases REGEX "^(TEST_CASE|SCENARIO)" LIMIT_COUNT 1)
      if(NOT cases)
        continue()
      endif()
    endif()
    cmake_path(GET file PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    string(REGEX REPLACE "_test$" "" short "${stem}")
    add_test(NAME "${name}: ${short}" COMMAND test_${name} "--source-file=*/${folder}/${stem}.cpp")
    set_tests_properties("${name}: ${short}" PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT ${TEST_TIMEOUT})
    if(CMAKE_BUILD_TYPE STREQUAL Coverage)
      # On one processor no two threads count a line at the same instant, which would lose counts.
      set_tests_properties("${name}: ${short}" PROPERTIES PROCESSOR_AFFINITY ON)
    endif()
    if(stem IN_LIST TEST_LONG)
      set_tests_properties("${name}: ${short}" PROPERTIES COST 100)
    endif()
  endforeach()
endfunction()
