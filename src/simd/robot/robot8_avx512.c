// The kernels of robot8.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 8
#include "simd/robot/robot8_kernel.h"

const robot8_kernels robot8_avx512 = {run_chain,           run_place,         run_half_turns,        run_near_boxes,
                                      run_near_boxes8,     run_near_spheres,  run_near_linked_boxes, run_place_balls,
                                      run_balls_in_region, run_balls_in_balls};
#else
#include "simd/robot/robot8.h"
#endif
