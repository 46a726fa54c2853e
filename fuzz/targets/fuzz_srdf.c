// SRDF, of a robot with a chain and a branch.
#include "robot.h"

static const char urdf[] =
    "<robot name=\"r\"><link name=\"base\"/><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/>"
    "<joint name=\"ja\" type=\"continuous\"><parent link=\"base\"/><child link=\"a\"/></joint>"
    "<joint name=\"jb\" type=\"planar\"><parent link=\"a\"/><child link=\"b\"/></joint>"
    "<joint name=\"jc\" type=\"floating\"><parent link=\"b\"/><child link=\"c\"/></joint>"
    "<joint name=\"jd\" type=\"fixed\"><parent link=\"base\"/><child link=\"d\"/></joint></robot>";

static char path[160];

static void remove_urdf(void) { (void)remove(path); }

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    size_t notes = 0;
    ovoid_robot_read_options options = {.note = fuzz_count_note, .context = &notes, .fixed_base = size % 2 == 0};
    if (!path[0]) {
        (void)snprintf(path, sizeof path, "%s", fuzz_write_file("robot.urdf", (const uint8_t *)urdf, sizeof urdf - 1));
        // Before the folder goes, which was made earlier.
        (void)atexit(remove_urdf);
    }
    ovoid_robot_file *file = ovoid_robot_file_read(path, fuzz_write_file("robot.srdf", data, size), &options, &error);
    if (file)
        fuzz_walk_robot(file);
    else
        fuzz_require_error(&error);
    ovoid_robot_file_destroy(file);
    return 0;
}
