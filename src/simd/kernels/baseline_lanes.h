// LANES of the kernels that every processor of a build runs: 2 by SIMD128 of WebAssembly, where nothing is chosen when
// a program starts, else 1, the scalar twins.
#ifndef OVOID_SIMD_KERNELS_BASELINE_LANES_H
#define OVOID_SIMD_KERNELS_BASELINE_LANES_H

#ifdef __wasm_simd128__
#define LANES 2
#else
#define LANES 1
#endif

#endif
