# What `cmake --install` copies, for find_package(sigs) too, and the Debian packages (cpack -G DEB). Components:
#   programs  the programs, their samples, documentation, man pages and completion
#   python    the Python module (python/CMakeLists.txt)
#   dev       headers and static libraries of the engine
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME programs)

install(TARGETS sigs RUNTIME)
if(SIGS_EDITOR)
  install(TARGETS sigs-editor RUNTIME)
  install(FILES assets/desktop/sigs-editor.desktop DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
  install(FILES assets/icons/sigs.svg DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps")
endif()

# Samples: in the layout of the source tree, as projects name their files relative to themselves.
set(samples "${CMAKE_INSTALL_DATADIR}/sigs")
install(DIRECTORY assets/models assets/footage assets/calibrations DESTINATION "${samples}/assets"
  FILES_MATCHING REGEX "\\.(obj|mtl|png|mp4|mkv|xml|csv|json|md)$")
install(DIRECTORY projects DESTINATION "${samples}")

# Made from the descriptions of --help (cli/describe).
install(DIRECTORY "${CMAKE_BINARY_DIR}/described/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(DIRECTORY "${CMAKE_BINARY_DIR}/described/bash/" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(DIRECTORY "${CMAKE_BINARY_DIR}/described/zsh/" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")

install(FILES README.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# The engine as a library: sigs::sigs is all of it, sigs::base and so on are its modules.
add_library(sigs_engine INTERFACE)
set_target_properties(sigs_engine PROPERTIES EXPORT_NAME sigs)
get_property(engine_modules GLOBAL PROPERTY sigs_engine_modules)
target_link_libraries(sigs_engine INTERFACE ${engine_modules})
foreach(module ${engine_modules})
  string(REGEX REPLACE "^sigs_" "" name "${module}")
  set_target_properties(${module} PROPERTIES EXPORT_NAME ${name})
endforeach()
set_target_properties(sigs_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS sigs_engine sigs_flags ${engine_modules} EXPORT sigs ARCHIVE COMPONENT dev)
install(DIRECTORY engine/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/sigs" COMPONENT dev FILES_MATCHING PATTERN "*.h")
# All that is installed, and nothing else: cmake --build build/release --target installed. CPack would build everything.
add_custom_target(installed DEPENDS sigs descriptions ${engine_modules})
if(SIGS_EDITOR)
  add_dependencies(installed sigs-editor)
endif()
if(TARGET sigs_python)
  add_dependencies(installed sigs_python)
endif()
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/sigs")
install(EXPORT sigs NAMESPACE sigs:: FILE sigsTargets.cmake DESTINATION "${package}" COMPONENT dev)
include(CMakePackageConfigHelpers)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/sigsConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES cmake/sigsConfig.cmake "${CMAKE_BINARY_DIR}/sigsConfigVersion.cmake" DESTINATION "${package}" COMPONENT dev)

include(cmake/package.cmake)
