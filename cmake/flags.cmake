# The language and the flags that every target of this project is compiled with. What is set here is set for this folder
# and those below it: a project around this one keeps its own.
set(CMAKE_C_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
  endif()
endif()

# No fast mathematics, whatever the project around this one uses: the bounds hold of IEEE arithmetic. It comes first, since
# it resets what follows. Contraction off: a fused multiply-add would give other bits on other machines and break the error bounds. No errno
# from mathematics: nobody reads it, and a root is then one instruction.
add_library(ovoid_flags INTERFACE)
target_compile_options(ovoid_flags INTERFACE -fno-fast-math -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wshadow
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes;-Wmissing-prototypes> $<$<BOOL:${OVOID_WERROR}>:-Werror>)

# 32-bit x86 computes in the x87's wider registers unless it is told otherwise; src/base/arithmetic.h refuses that.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__i386__)
  #error none
  #endif
  int main(void) { return 0; }" OVOID_IS_I386)
if(OVOID_IS_I386)
  target_compile_options(ovoid_flags INTERFACE -msse2 -mfpmath=sse)
endif()

# Windows' own printf knows no %zu.
if(MINGW)
  target_compile_definitions(ovoid_flags INTERFACE __USE_MINGW_ANSI_STDIO=1)
endif()

# Where the flags allow fused operations at all (-march=native), gcc 12 makes them of alternating sums and differences of
# products (a b + c, a b - c side by side) though contraction is off; that pattern is of its vectorizer of straight-line
# code. scripts/bits.sh looks for what is left.
check_c_source_compiles("#if !defined(__FMA__) && !defined(__FMA4__) && !defined(__AVX512F__)
  #error none
  #endif
  int main(void) { return 0; }" OVOID_HAS_FUSED)
if(OVOID_HAS_FUSED AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
  target_compile_options(ovoid_flags INTERFACE -fno-tree-slp-vectorize)
endif()

# Clang 14 may move a load that WebAssembly spreads over both lanes (LOAD_SPLAT) behind a later store to the same place:
# x = M x lost a coordinate. Its own vectorizers bring that about; the kernels in src/simd store to other places than
# they load from.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
  # Of the optimiser: a later -Os would turn clang's own options round.
  target_compile_options(ovoid_flags INTERFACE "SHELL:-mllvm -vectorize-slp=false" "SHELL:-mllvm -vectorize-loops=false")
endif()

# A struct of some hundred bytes is cleared and copied by 16 bytes a step; gcc's own choice, rep stos and rep movs, takes
# longer to start than a query's first look does to run.
include(CheckCCompilerFlag)
set(block_strategy vector_loop:1024:noalign,libcall:-1:noalign)
check_c_compiler_flag("-mmemset-strategy=${block_strategy}" OVOID_HAS_BLOCK_STRATEGY)
if(OVOID_HAS_BLOCK_STRATEGY)
  target_compile_options(ovoid_flags INTERFACE
    $<$<COMPILE_LANGUAGE:C>:-mmemset-strategy=${block_strategy};-mmemcpy-strategy=${block_strategy}>)
endif()

if(OVOID_SANITIZE)
  add_compile_options(-fsanitize=${OVOID_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${OVOID_SANITIZE})
elseif(OVOID_WERROR AND NOT WIN32)
  # A library that lacks a symbol fails here, not at its user's. (Sanitized ones find their runtime in the program.)
  add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,SHARED_LIBRARY>:-Wl,-z,defs>)
endif()
