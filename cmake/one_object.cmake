# A static archive whose internal names are its own. A linker sees every global symbol of an archive, hidden or not, so a
# program that defines a function named like an internal one would have it called by the library. Therefore the archive
# holds one object: all objects linked partially (ld -r), then all hidden symbols made local (objcopy). What the headers
# mark with OVOID_API is left. Costs: whoever links one function links the whole object; so each function has a section
# of its own, and -Wl,--gc-sections drops what is not used.
#
# The partial link goes through the compiler's driver, which knows the target's linker, for cross compilers too; objcopy
# is the toolchain's (CMAKE_OBJCOPY). gcc's link-time optimisation ends in this link: the archive holds machine code.
# COFF (MinGW) has no visibility: there all names but ovoid_... become local. Where a trial at configure time shows that
# neither works (clang's link-time optimisation without lld, other formats, no objcopy), the archive holds the plain
# objects, and a message says so.

# The driver with what chooses the target; -fno-sanitize keeps the sanitizers' runtime for the program's own link.
separate_arguments(ovoid_partial_link UNIX_COMMAND "${CMAKE_C_FLAGS}")
if(CMAKE_C_COMPILER_TARGET)
  list(APPEND ovoid_partial_link ${CMAKE_C_COMPILE_OPTIONS_TARGET}${CMAKE_C_COMPILER_TARGET})
endif()
if(CMAKE_SYSROOT)
  list(APPEND ovoid_partial_link ${CMAKE_C_COMPILE_OPTIONS_SYSROOT}${CMAKE_SYSROOT})
endif()
set(ovoid_compile_one ${CMAKE_C_COMPILER} ${ovoid_partial_link} -fvisibility=hidden -c)
if(CMAKE_INTERPROCEDURAL_OPTIMIZATION)
  list(APPEND ovoid_compile_one ${CMAKE_C_COMPILE_OPTIONS_IPO})
endif()
set(ovoid_partial_link ${CMAKE_C_COMPILER} ${ovoid_partial_link} -fno-sanitize=all -nostdlib -r)
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
  list(APPEND ovoid_partial_link -flinker-output=nolto-rel)
endif()

# ovoid_try_localizing(RESULT OPTIONS...): whether, in a trial of two objects, objcopy with these options leaves the
# public name alone and the internal ones not.
function(ovoid_try_localizing result)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/one_object)
  file(WRITE ${folder}/a.c "int inner(void);\n__attribute__((visibility(\"default\"))) int ovoid_outer(void);\n"
    "int ovoid_outer(void) { return inner(); }\n")
  file(WRITE ${folder}/b.c "int inner(void);\nint inner(void) { return 7; }\n")
  set(${result} FALSE PARENT_SCOPE)
  foreach(command
      "${ovoid_compile_one};a.c;-o;a.o" "${ovoid_compile_one};b.c;-o;b.o" "${ovoid_partial_link};a.o;b.o;-o;one.o"
      "${CMAKE_OBJCOPY};${ARGN};one.o")
    execute_process(COMMAND ${command} WORKING_DIRECTORY ${folder} RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
    if(code)
      return()
    endif()
  endforeach()
  execute_process(COMMAND ${CMAKE_NM} -g --defined-only one.o WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE names
    ERROR_QUIET)
  if(names MATCHES "ovoid_outer" AND NOT names MATCHES "inner")
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

set(ovoid_localize "")
if(OVOID_ONE_OBJECT)
  foreach(options "--localize-hidden" "--wildcard;--keep-global-symbol=ovoid_*;--keep-global-symbol=_ovoid_*")
    if(CMAKE_OBJCOPY AND NOT ovoid_localize)
      ovoid_try_localizing(works ${options})
      if(works)
        set(ovoid_localize ${CMAKE_OBJCOPY} ${options})
      endif()
    endif()
  endforeach()
  if(NOT ovoid_localize)
    message(STATUS "the static archives keep their internal names: no partial link and objcopy for this target")
  endif()
endif()
set(OVOID_ARCHIVES plain CACHE INTERNAL "What the static archives hold: one object, or plain ones")
if(ovoid_localize)
  set(OVOID_ARCHIVES one CACHE INTERNAL "")
endif()

# ovoid_add_archive(NAME OBJECTS): a static library NAME of the objects of the target OBJECTS, as one where that works.
function(ovoid_add_archive name objects)
  if(NOT ovoid_localize)
    add_library(${name} STATIC $<TARGET_OBJECTS:${objects}>)
    return()
  endif()
  set(one ${CMAKE_CURRENT_BINARY_DIR}/${name}${CMAKE_C_OUTPUT_EXTENSION})
  add_custom_command(OUTPUT ${one}
    COMMAND ${ovoid_partial_link} -o ${one} $<TARGET_OBJECTS:${objects}>
    COMMAND ${ovoid_localize} ${one}
    DEPENDS ${objects} $<TARGET_OBJECTS:${objects}> COMMENT "Linking ${name} into one object"
    COMMAND_EXPAND_LISTS VERBATIM)
  add_library(${name} STATIC ${one})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE C)
  target_compile_options(${objects} PRIVATE -ffunction-sections -fdata-sections)
endfunction()
