# The Debian packages: sigs, all that runs, and libsigs-dev, the engine for programs of others.
# scripts/package.sh makes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sigs)
set(CPACK_PACKAGE_CONTACT "The SIGS developers <sigs@sigs.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL programs dev)
if(TARGET sigs_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME sigs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Encounters of aircraft put into real UAV footage, with exact truth
SIGS puts simulated aircraft into real footage from an unmanned aircraft,
through that camera's own lens, and writes the truth beside it: position,
distance, attitude, boxes and masks of each aircraft in each frame. It has a
program for the command line, a visual editor and a Python module.")
# Loaded by name, or by other programs' means, so that no tool sees them: OpenCV's library of image files, Mesa's OpenGL
# without a display, fonts of the editor.
set(runtime_depends libegl1 libegl-mesa0 libgl1-mesa-dri libgl1 libglx-mesa0 fonts-inter fonts-dejavu-core)
get_target_property(image_codecs opencv_imgcodecs LOCATION)
execute_process(COMMAND dpkg-query --search "${image_codecs}" OUTPUT_VARIABLE owner ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(owner MATCHES "^([a-z0-9.+-]+)[:,]")
  list(APPEND runtime_depends "${CMAKE_MATCH_1}")
elseif(EXISTS /usr/bin/dpkg-query)
  message(STATUS "No package owns ${image_codecs}: a Debian package made here will not name it")
endif()
if(TARGET sigs_python)
  # The extension fits one minor version of Python alone.
  get_target_property(python_suffix sigs_python SUFFIX)
  if(python_suffix MATCHES "cpython-([0-9])([0-9]+)")
    math(EXPR next_minor "${CMAKE_MATCH_2} + 1")
    list(APPEND runtime_depends "python3 (>= ${CMAKE_MATCH_1}.${CMAKE_MATCH_2})" "python3 (<< ${CMAKE_MATCH_1}.${next_minor})")
  endif()
  list(APPEND runtime_depends python3-numpy)
endif()
list(JOIN runtime_depends ", " CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "ffmpeg")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libsigs-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Engine of SIGS for programs of your own
Headers, static libraries and the CMake package of the library with which
SIGS puts simulated aircraft into footage: find_package(sigs).")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libopencv-dev, libopencv-contrib-dev, libavformat-dev, libavcodec-dev, libavutil-dev, libswscale-dev, libpng-dev, libglm-dev, libtinyobjloader-dev, libassimp-dev, libepoxy-dev, libegl-dev, nlohmann-json3-dev, libpugixml-dev, libyaml-cpp-dev, libexpected-dev, libfmt-dev, libgeographiclib-dev, pkg-config")

# What Debian asks of every package: the licence and the changes beside it. SOURCE_DATE_EPOCH, where it is set, is the
# date of the changes.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(READ LICENSE licence)
string(REGEX REPLACE "\n+$" "" licence "${licence}")
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n" "\n " licence "${licence}")
foreach(name sigs libsigs-dev)
  set(folder "${CMAKE_BINARY_DIR}/debian/${name}")
  file(MAKE_DIRECTORY "${folder}")
  file(CONFIGURE OUTPUT "${folder}/copyright" @ONLY CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: SIGS

Files: *
Copyright: SIGS contributors
License: Expat

License: Expat
 @licence@
")
  file(CONFIGURE OUTPUT "${folder}/changelog" @ONLY CONTENT
"sigs (@PROJECT_VERSION@) unstable; urgency=medium

  * The changes are listed in the project's file CHANGELOG.md.

 -- @CPACK_PACKAGE_CONTACT@  @date@
")
  execute_process(COMMAND gzip -9nc "${folder}/changelog" OUTPUT_FILE "${folder}/changelog.gz")
endforeach()
install(FILES "${CMAKE_BINARY_DIR}/debian/sigs/copyright" "${CMAKE_BINARY_DIR}/debian/sigs/changelog.gz" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/sigs")
install(FILES "${CMAKE_BINARY_DIR}/debian/libsigs-dev/copyright" "${CMAKE_BINARY_DIR}/debian/libsigs-dev/changelog.gz" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libsigs-dev" COMPONENT dev)

include(CPack)
cpack_add_component_group(runtime)
cpack_add_component_group(dev)
cpack_add_component(programs GROUP runtime)
cpack_add_component(python GROUP runtime)
cpack_add_component(dev GROUP dev)
