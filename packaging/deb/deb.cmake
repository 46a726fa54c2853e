# Debian packages by CPack, one for each component of the installation; scripts/deb.sh builds them with Debian's flags.
# Included at the end of the top project. What dpkg wants beyond CPack's own (dependencies, shlibs, symbols, changelog,
# compressed pages) is added by finish.cmake, which CPack runs after its installation and before it packs.
#
# The names: Debian Policy 8.1 names a package of a shared library after its soname: libovoid.so.0.3 is in libovoid0.3. Two minor
# versions are then installed side by side. libovoid_io has packages of its own, since it
# needs jansson and Assimp, and the core must not bring these along; libovoid_robot too. The tool holds both libraries statically: its
# answers are those of the build that was tested, whatever else is installed.
set(CPACK_OVOID_SOURCE_DIR ${PROJECT_SOURCE_DIR})
set(CPACK_OVOID_LIBDIR ${CMAKE_INSTALL_LIBDIR})
set(CPACK_OVOID_LIBRARY_RUNTIME libovoid)
set(CPACK_OVOID_LIBRARY_IO libovoid_io)
set(CPACK_OVOID_LIBRARY_ROBOT libovoid_robot)
# The package of Assimp, which is loaded and not linked, so that dpkg-shlibdeps does not see it: libassimp.so.5 is in libassimp5.
if(TARGET ovoid_assimp)
  string(REGEX REPLACE "[.]so[.]?" "" CPACK_OVOID_LOADED ${OVOID_ASSIMP_NAME})
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ovoid)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES OFF)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SOURCE ovoid)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The ovoid developers <ovoid@localhost>")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(full ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

# ovoid_deb(COMPONENT PACKAGE SECTION DEPENDS DESCRIPTION): the description's first line is the short one.
function(ovoid_deb component package section depends description)
  string(TOUPPER ${component} upper)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}" PARENT_SCOPE)
endfunction()

set(about "ovoid answers whether convex bodies touch, how far apart they are, how
deep they overlap and when moving ones meet. Every answer is a bracket that
holds with rounding included, and has a proof that anyone can check.
.
")
set(so ${OVOID_SOVERSION})
ovoid_deb(runtime libovoid${so} libs "" "proximity queries between convex bodies, with proofs
${about}This package has the shared library.")
ovoid_deb(dev libovoid-dev libdevel "libovoid${so} (= ${full})" "proximity queries between convex bodies (development)
${about}This package has the headers, the static library, the CMake package
and the pkg-config file.")
# Headers for engines, where these are.
foreach(name Bullet MuJoCo DART)
  string(TOLOWER ${name} engine)
  if(TARGET ovoid_${engine})
    set(depends "libovoid-dev (= ${full}), lib${engine}-dev")
    ovoid_deb(${engine}_dev libovoid-${engine}-dev libdevel "${depends}" "proven contacts in ${name} (development)
${about}This package has the header that lets the physics engine ${name} take its
contacts from libovoid.")
  endif()
endforeach()
if(TARGET ovoid_fcl)
  ovoid_deb(fcl_dev libovoid-fcl-dev libdevel "libovoid-dev (= ${full}), libfcl-dev"
    "FCL's calls answered by ovoid (development)
${about}This package has the header that answers the calls of FCL, the Flexible
Collision Library, over FCL's own types.")
  ovoid_deb(fcl ovoid-fcl libs "" "FCL's calls answered by ovoid, in programs as they are
${about}This package has the library that a program of FCL, the Flexible Collision
Library, loads before it (LD_PRELOAD): its calls are answered by ovoid.")
endif()
if(TARGET ovoid_io_shared)
  ovoid_deb(io libovoid-io${so} libs "" "meshes, scenes and results for ovoid
${about}This package has the shared library that reads meshes and scenes and
writes results and pictures.")
  set(depends "libovoid-dev (= ${full}), libovoid-io${so} (= ${full}), libjansson-dev")
  ovoid_deb(io_dev libovoid-io-dev libdevel "${depends}" "meshes, scenes and results for ovoid (development)
${about}This package has the header, the static library and the pkg-config file of
the library that reads meshes and scenes and writes results and pictures.")
endif()
if(TARGET ovoid_robot_shared)
  ovoid_deb(robot libovoid-robot${so} libs "" "robots for ovoid
${about}This package has the shared library of robots: where their links are and
what these touch.")
  set(depends "libovoid-dev (= ${full}), libovoid-robot${so} (= ${full})")
  if(OVOID_IO)
    string(APPEND depends ", libovoid-io-dev (= ${full}), libexpat1-dev, libyaml-dev")
  endif()
  ovoid_deb(robot_dev libovoid-robot-dev libdevel "${depends}"
    "robots for ovoid (development)
${about}This package has the header, the static library and the pkg-config file of
the library of robots.")
  ovoid_deb(ompl_dev libovoid-ompl-dev libdevel "libovoid-robot-dev (= ${full}), libompl-dev"
    "proven motion planning of robots in OMPL (development)
${about}This package has the header that lets planners of OMPL check states and
motions with libovoid_robot, so that each motion is proven free.")
endif()
if(TARGET ovoid_cli)
  ovoid_deb(tool ovoid science "" "proximity of meshes from the command line, with proofs
${about}This package has the tool. It fits meshes, answers pairs and lists of pairs,
checks scenes and motions, verifies the proofs of answers and draws pictures.")
endif()
if(TARGET ovoid_plan)
  ovoid_deb(plan ovoid-plan science "ovoid (= ${full})" "motion planning of robots with proofs
${about}This package lets the tool plan: \"ovoid robot plan\" finds paths of robots
with planners of OMPL, each motion of which is proven free.")
endif()
include(CPack)
