// The installed core: what an outsider's first program does. Exit 0 where header and library are of one version and two
// unit boxes three apart are one apart.
#include <ovoid/ovoid.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    char version[32];
    (void)snprintf(version, sizeof version, "%d.%d.%d", OVOID_VERSION_MAJOR, OVOID_VERSION_MINOR, OVOID_VERSION_PATCH);
    if (strcmp(version, ovoid_get_version()) != 0) return 1;
    ovoid_error error = {0};
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    if (!box) return 2;
    ovoid_pair pair = {box, box, {{0, 0, 0}, {1, 0, 0, 0}}, {{3, 0, 0}, {1, 0, 0, 0}}};
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    ovoid_shape_destroy(box);
    return answer.status == OVOID_SEPARATED && answer.lower <= 1 && answer.upper >= 1 ? 0 : 3;
}
