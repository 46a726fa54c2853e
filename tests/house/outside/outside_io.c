// The installed libovoid_io: exit 0 where it links, knows a unit and refuses a file that is not there with a code.
#include <ovoid/io.h>

int main(void) {
    ovoid_error error = {0};
    ovoid_mesh *mesh = ovoid_mesh_read("there is no such file.off", NULL, &error);
    if (mesh || error.code != OVOID_ERROR_FILE) return 1;
    return ovoid_unit_get_scale("mm", "m") == 1e-3 ? 0 : 2;
}
