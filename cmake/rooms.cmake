# What every target of ours compiles with: strict warnings, and the engine's folder as include root.
add_library(sigs_flags INTERFACE)
target_include_directories(sigs_flags INTERFACE "${CMAKE_SOURCE_DIR}/engine")
target_include_directories(sigs_flags SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
target_compile_options(sigs_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow
  -Wnon-virtual-dtor
  # Leaving a field at its default is what designated initialisers are for.
  -Wno-missing-field-initializers)
# The same sum in the same order everywhere: a fused multiply-add on one machine alone would change the bytes.
target_compile_options(sigs_flags INTERFACE -ffp-contract=off)
target_link_libraries(sigs_flags INTERFACE glm::glm tl::expected)

# sigs_room(NAME SOURCES a.cpp ... LINKS other libraries): the static library sigs_NAME.
function(sigs_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(sigs_${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(sigs_${name} PUBLIC sigs_flags ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS})
endfunction()

# sigs_test(NAME [SERIAL] SOURCES a_test.cpp ... LINKS libraries): one doctest program, each test case known to ctest by
# name. A case that prints "SKIPPED" counts as skipped. SERIAL: nothing else runs beside its cases.
function(sigs_test name)
  cmake_parse_arguments(TEST "SERIAL" "" "SOURCES;LINKS" ${ARGN})
  add_executable(test_${name} ${TEST_SOURCES})
  target_link_libraries(test_${name} PRIVATE sigs_test_support ${TEST_LINKS})
  doctest_discover_tests(test_${name} TEST_PREFIX "${name}: "
    PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED" TIMEOUT 600 RUN_SERIAL ${TEST_SERIAL})
endfunction()
