// Two unit boxes three apart are one apart.
#include <ovoid/ovoid.h>

int main(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    if (!box) return 1;
    ovoid_pair pair = {box, box, {{0, 0, 0}, {1, 0, 0, 0}}, {{3, 0, 0}, {1, 0, 0, 0}}};
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    ovoid_shape_destroy(box);
    return answer.lower <= 1 && answer.upper >= 1 ? 0 : 2;
}
