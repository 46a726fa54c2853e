// A table of five boxes and a mug of ten: the nearest parts, their distance, and its proof.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

// The mug: nine slabs in a ring and a bottom.
static ovoid_compound *create_mug(const ovoid_shape *slab, const ovoid_shape *bottom, ovoid_error *error) {
    ovoid_posed_shape parts[10] = {{bottom, {{0, 0, 0.005}, {1, 0, 0, 0}}}};
    for (int i = 1; i < 10; i++) {
        double half = i * 3.14159265358979 / 9;
        parts[i] = (ovoid_posed_shape){
            slab, {{0.04 * cos(2 * half), 0.04 * sin(2 * half), 0.06}, {cos(half), 0, 0, sin(half)}}};
    }
    return ovoid_compound_create(parts, 10, NULL, error);
}

int main(void) {
    ovoid_error error = {.message = ""};
    ovoid_shape *top = ovoid_shape_create_box((ovoid_vec3){0.6, 0.4, 0.02}, NULL, &error);
    ovoid_shape *leg = ovoid_shape_create_box((ovoid_vec3){0.03, 0.03, 0.35}, NULL, &error);
    ovoid_shape *slab = ovoid_shape_create_box((ovoid_vec3){0.004, 0.016, 0.05}, NULL, &error);
    ovoid_shape *bottom = ovoid_shape_create_prism(&(ovoid_prism){0.04, 0.005, 18}, NULL, &error);
    if (!top || !leg || !slab || !bottom) return fprintf(stderr, "%s\n", error.message), 1;

    const ovoid_quat none = {1, 0, 0, 0};
    ovoid_posed_shape parts[5] = {{top, {{0, 0, 0.72}, none}}};
    for (int i = 0; i < 4; i++)
        parts[1 + i] = (ovoid_posed_shape){leg, {{i & 1 ? 0.55 : -0.55, i & 2 ? 0.35 : -0.35, 0.35}, none}};
    ovoid_compound *table = ovoid_compound_create(parts, 5, NULL, &error), *mug = create_mug(slab, bottom, &error);
    if (!table || !mug) return fprintf(stderr, "%s\n", error.message), 1;

    // The mug is lowered onto the table; each query starts from the proof of the one before.
    ovoid_body_pair pair = {{.compound = table, .pose = {{0, 0, 0}, none}},
                            {.compound = mug, .pose = {{0.2, 0.1, 0.9}, none}}};
    ovoid_exclusion items[200];
    ovoid_exclusions all = {.items = items, .capacity = 200};
    ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    int refused = 0;
    for (double z = 0.9; z > 0.73; z -= 0.05) {
        pair.b.pose.position.z = z;
        ovoid_body_proof known = ovoid_body_answer_get_proof(&x);
        x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.earlier = &known, .exclusions = &all});
        printf("z %.2f: part %u of the table, part %u of the mug: %s, %.6f apart; %zu exclusions, %u of 50 pairs\n", z,
               x.part_a, x.part_b, ovoid_status_get_name(x.status), x.lower, all.count, x.tested);
        refused += ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error) != OVOID_OK;
    }
    // From 0.75 to the table's 0.74.
    int wrong = refused || x.part_a != 0 || x.part_b != 0 || fabs(x.lower - 0.01) > 1e-8;

    ovoid_compound_destroy(table);
    ovoid_compound_destroy(mug);
    ovoid_shape *shapes[4] = {top, leg, slab, bottom};
    for (int i = 0; i < 4; i++) ovoid_shape_destroy(shapes[i]);
    return wrong;
}
