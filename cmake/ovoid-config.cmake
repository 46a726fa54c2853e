# find_package(ovoid [COMPONENTS io robot]): the targets ovoid::ovoid and, where they are installed, ovoid::ovoid_io and
# ovoid::ovoid_robot, each also with _static; without it they are the shared libraries, or the static ones where these alone are installed.
include(${CMAKE_CURRENT_LIST_DIR}/ovoid-targets.cmake)

# ovoid_import(NAME): ovoid::NAME, a library that an archive needs, wherever this project finds its packages.
macro(ovoid_import name)
  if(NOT TARGET ovoid::${name})
    find_library(OVOID_${name}_LIBRARY ${name})
    mark_as_advanced(OVOID_${name}_LIBRARY)
    add_library(ovoid::${name} INTERFACE IMPORTED)
    if(OVOID_${name}_LIBRARY)
      target_link_libraries(ovoid::${name} INTERFACE ${OVOID_${name}_LIBRARY})
    else()
      target_link_libraries(ovoid::${name} INTERFACE ${name})
    endif()
  endif()
endmacro()

# What libovoid_io's archive needs.
if(EXISTS ${CMAKE_CURRENT_LIST_DIR}/ovoid_io-targets.cmake)
  ovoid_import(jansson)
  include(${CMAKE_CURRENT_LIST_DIR}/ovoid_io-targets.cmake)
endif()

# The same of libovoid_robot's.
if(EXISTS ${CMAKE_CURRENT_LIST_DIR}/ovoid_robot-targets.cmake)
  ovoid_import(expat)
  ovoid_import(yaml)
  include(${CMAKE_CURRENT_LIST_DIR}/ovoid_robot-targets.cmake)
endif()

foreach(ovoid_name ovoid ovoid_io ovoid_robot)
  if(TARGET ovoid::${ovoid_name}_static AND NOT TARGET ovoid::${ovoid_name})
    add_library(ovoid::${ovoid_name} INTERFACE IMPORTED)
    target_link_libraries(ovoid::${ovoid_name} INTERFACE ovoid::${ovoid_name}_static)
  endif()
endforeach()

foreach(ovoid_name io robot)
  set(ovoid_${ovoid_name}_FOUND FALSE)
  if(TARGET ovoid::ovoid_${ovoid_name})
    set(ovoid_${ovoid_name}_FOUND TRUE)
  endif()
endforeach()
foreach(ovoid_name ${ovoid_FIND_COMPONENTS})
  if(ovoid_FIND_REQUIRED_${ovoid_name} AND NOT ovoid_${ovoid_name}_FOUND)
    set(ovoid_FOUND FALSE)
    set(ovoid_NOT_FOUND_MESSAGE "ovoid has no component ${ovoid_name}, or it is not installed (there are: io, robot)")
  endif()
endforeach()
unset(ovoid_name)
