// URDF: what is read makes a robot.
#include "robot.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    size_t notes = 0;
    ovoid_robot_read_options options = {.ros_package_path = "",
                                        .ament_prefix_path = "",
                                        .note = fuzz_count_note,
                                        .context = &notes,
                                        .visual = size % 2 == 0};
    ovoid_robot_file *file = ovoid_robot_file_read(fuzz_write_file("robot.urdf", data, size), NULL, &options, &error);
    if (file)
        fuzz_walk_robot(file);
    else
        fuzz_require_error(&error);
    ovoid_robot_file_destroy(file);
    return 0;
}
