# Installation: headers, libraries, tool, CMake package and pkg-config files. Its components are those of packages: runtime
# and dev of the core, io and io_dev of libovoid_io, robot and robot_dev of libovoid_robot, ompl_dev and fcl_dev of the headers for OMPL and FCL, fcl of libovoid_fcl, bullet_dev, mujoco_dev and dart_dev of those for engines, tool, plan of `ovoid robot plan`.

# install_library(NAME RUNTIME DEV NEEDED): a library in its kinds, its part of the CMake package, its pkg-config file;
# NEEDED is what its archive needs.
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/ovoid)
function(install_library name runtime dev needed)
  set(libraries ${name}_static)
  set(for_archive " ${needed}")
  set(for_all "")
  if(TARGET ${name}_shared)
    list(APPEND libraries ${name}_shared)
  else()
    set(for_all ${for_archive})
  endif()
  install(TARGETS ${libraries} EXPORT ${name}-targets
    RUNTIME COMPONENT ${runtime} LIBRARY COMPONENT ${runtime} NAMELINK_COMPONENT ${dev} ARCHIVE COMPONENT ${dev})
  install(EXPORT ${name}-targets NAMESPACE ovoid:: DESTINATION ${package_folder} COMPONENT ${dev})
  # From the folder of the .pc files up to the prefix.
  file(RELATIVE_PATH up_to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${dev})
endfunction()

install_library(ovoid runtime dev "-lm -lpthread")
install(DIRECTORY include/ovoid TYPE INCLUDE COMPONENT dev FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp" PATTERN io.h EXCLUDE
  PATTERN io.hpp EXCLUDE PATTERN ompl.hpp EXCLUDE PATTERN fcl.hpp EXCLUDE PATTERN fcl EXCLUDE PATTERN "robot*" EXCLUDE)
# Headers for engines need nothing to install; what they include is the engine's and the core's.
set(adapters_folder ${PROJECT_SOURCE_DIR}/adapters/include/ovoid)
install(FILES ${adapters_folder}/adapter.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT dev)
install(FILES ${adapters_folder}/bullet.hpp ${adapters_folder}/bullet_shapes.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT bullet_dev)
install(FILES ${adapters_folder}/mujoco.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT mujoco_dev)
install(FILES ${adapters_folder}/dart.hpp ${adapters_folder}/dart_shapes.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT dart_dev)
# Needs nothing to install; what it includes is FCL's and the core's.
install(FILES include/ovoid/fcl.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT fcl_dev)
install(DIRECTORY include/ovoid/fcl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT fcl_dev)
if(TARGET ovoid_fcl)
  install(TARGETS ovoid_fcl LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/ovoid COMPONENT fcl)
endif()
if(TARGET ovoid_io_static)
  set(needed -ljansson)
  if(TARGET ovoid_assimp AND CMAKE_DL_LIBS)
    string(APPEND needed " -l${CMAKE_DL_LIBS}")
  endif()
  install_library(ovoid_io io io_dev "${needed}")
  install(FILES include/ovoid/io.h include/ovoid/io.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT io_dev)
endif()
if(TARGET ovoid_robot_static)
  set(below ovoid)
  set(needed "-lm -lpthread")
  set(unread PATTERN "robot_io.h*" EXCLUDE PATTERN "robot_proof.h" EXCLUDE)
  if(TARGET ovoid_io_static)
    set(below ovoid_io)
    string(APPEND needed " -lexpat -lyaml")
    set(unread "")
  endif()
  install_library(ovoid_robot robot robot_dev "${needed}")
  install(DIRECTORY include/ovoid TYPE INCLUDE COMPONENT robot_dev FILES_MATCHING ${unread} PATTERN "robot*.h"
    PATTERN "robot*.hpp")
  # Needs nothing to install; what it includes is OMPL's and libovoid_robot's.
  install(FILES include/ovoid/ompl.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ovoid COMPONENT ompl_dev)
endif()
if(TARGET ovoid_cli)
  install(TARGETS ovoid_cli COMPONENT tool)
  install(FILES cli/ovoid.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
  install(FILES cli/ovoid.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ovoid COMPONENT tool)
  # The template of pages, where `make page` has built it.
  install(FILES ${PROJECT_BINARY_DIR}/page.html DESTINATION ${CMAKE_INSTALL_DATADIR}/ovoid COMPONENT tool OPTIONAL)
endif()

if(TARGET ovoid_plan)
  install(TARGETS ovoid_plan COMPONENT plan)
  # Its manual is the tool's.
  file(WRITE ${PROJECT_BINARY_DIR}/ovoid-plan.1 ".so man1/ovoid.1\n")
  install(FILES ${PROJECT_BINARY_DIR}/ovoid-plan.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT plan)
endif()

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ovoid-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/ovoid-config.cmake ${PROJECT_BINARY_DIR}/ovoid-config-version.cmake DESTINATION ${package_folder}
  COMPONENT dev)
