# find_package(ovoid): the targets ovoid::ovoid and, where it was built, ovoid::ovoid_io; each also with _static.
include(${CMAKE_CURRENT_LIST_DIR}/ovoid-targets.cmake)
