# What cannot be built here is a test all the same: it says what is missing, and is counted as skipped.
set(package_ovoid_judge "libgmp-dev (GMP)")
set(package_ovoid_assimp "libassimp-dev (Assimp)")
set(package_ovoid_ompl "libompl-dev (OMPL)")
set(package_fcl "libfcl-dev (FCL)")
set(package_ovoid_qhull "libqhull-dev (Qhull)")
set(package_ovoid_io_static "libovoid_io (OVOID_IO, libjansson-dev)")
set(package_ovoid_io_internal "${package_ovoid_io_static}")
set(package_ovoid_robot_read "libovoid_robot and libovoid_io (OVOID_ROBOT, OVOID_IO)")
set(package_ovoid_robot_internal "libovoid_robot (OVOID_ROBOT)")
function(add_skipped name count library)
  add_test(NAME ${name} COMMAND sh -c
    "echo 'skipped: ${name} needs ${package_${library}}' && echo '0 passed, 0 failed, ${count} skipped'")
endfunction()
