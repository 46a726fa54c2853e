# What ovoid stands on. The core: libm. libovoid_io: jansson and Assimp. The exact judge: GMP. One test: Qhull, as a peer.

# ovoid_find(NAME header library package): an interface target ovoid_NAME, or a sentence that names what is missing.
function(ovoid_find name header library package required)
  string(TOUPPER ${name} upper)
  find_path(${upper}_INCLUDE ${header})
  find_library(${upper}_LIBRARY ${library})
  if(${upper}_INCLUDE AND ${upper}_LIBRARY)
    add_library(ovoid_${name} INTERFACE)
    target_include_directories(ovoid_${name} SYSTEM INTERFACE ${${upper}_INCLUDE})
    target_link_libraries(ovoid_${name} INTERFACE ${${upper}_LIBRARY})
  elseif(required)
    message(FATAL_ERROR "${name} is missing (Debian: ${package}); scripts/setup.sh installs all that is needed")
  endif()
endfunction()

ovoid_find(qhull libqhull_r/libqhull_r.h qhull_r libqhull-dev FALSE)
if(OVOID_IO)
  ovoid_find(jansson jansson.h jansson libjansson-dev TRUE)
  # Without it, STL, OBJ, OFF and PLY are still read.
  if(OVOID_ASSIMP)
    ovoid_find(assimp assimp/cimport.h assimp libassimp-dev FALSE)
  endif()
endif()
ovoid_find(gmp gmp.h gmp libgmp-dev FALSE)
