# Everything is compiled for libFuzzer with AddressSanitizer and UndefinedBehaviorSanitizer: what is undefined, a conversion
# to an integer that cannot hold the number, an index outside of a container of the standard library, ends the program.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "SIGS_FUZZ needs clang: cmake -DCMAKE_CXX_COMPILER=clang++-14")
endif()
add_compile_options(-O1 -g1 -fno-omit-frame-pointer
  -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all)
add_link_options(-fsanitize=address,undefined)
add_compile_definitions(_GLIBCXX_ASSERTIONS)
