// Real compounds: 80 objects decomposed into convex parts. Truth: the depth of every pair of parts for the small ones,
// and for all of them the answer's own check, which searches nothing.
#include "compounds.h"
#include "files.h"

enum { FILES = 80, CAPACITY = 100000 };
static ovoid_exclusion items[CAPACITY];

/// One file's shapes and the compound of them.
typedef struct object {
    ovoid_shapes *shapes;
    ovoid_compound *compound;
    double reach;
} object;

static object read_object(const char *path) {
    ovoid_read_options read = {.parts = 1};
    ovoid_error error = {.message = ""};
    object o = {ovoid_shapes_read_file(path, &read, NULL, &error), NULL, 0};
    if (!CHECK(o.shapes != NULL)) {
        printf("  %s\n", error.message);
        return o;
    }
    size_t count = ovoid_shapes_get_count(o.shapes);
    ovoid_posed_shape *parts = calloc(count, sizeof *parts);
    for (size_t i = 0; i < count; i++)
        parts[i] = (ovoid_posed_shape){ovoid_shapes_get(o.shapes, i).shape, ovoid_pose_make_identity()};
    o.compound = ovoid_compound_create(parts, count, NULL, &error);
    free(parts);
    if (!CHECK(o.compound != NULL)) return o;
    ovoid_ellipsoid e = ovoid_compound_get_outer(o.compound);
    o.reach = sqrt(e.q.xx + e.q.yy + e.q.zz);
    return o;
}

static void destroy_object(object *o) {
    ovoid_compound_destroy(o->compound);
    ovoid_shapes_destroy(o->shapes);
}

static void check_checks(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error = {.message = ""};
    CHECK_LE(all->count, CAPACITY);
    if (!CHECK(ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, &error) == OVOID_OK))
        printf("  %s\n", error.message);
}

static void check_pair(const object *a, const object *b, uint64_t *s) {
    double reach = 0.6 * (a->reach + b->reach);
    ovoid_body_pair pair = {{.compound = a->compound, .pose = {random_vec3(s, reach), random_quat(s)}},
                            {.compound = b->compound, .pose = {random_vec3(s, reach), random_quat(s)}}};
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_body_answer distance = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_checks(&pair, &distance, &all);
    ovoid_body_answer collide = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_checks(&pair, &collide, &all);
    CHECK_EQ(collide.status, distance.status);
    ovoid_body_answer depth = ovoid_body_depth(&pair, NULL, NULL);
    CHECK_LE(depth.lower, distance.upper);
    CHECK_LE(distance.lower, depth.upper);
    if (get_count(&pair.a) * get_count(&pair.b) > 150) return;
    bracket truth = find_brute(&pair, 1);
    CHECK_LE(depth.lower, truth.upper);
    CHECK_LE(truth.lower, depth.upper);
    CHECK_LE(depth.upper - depth.lower, 1e-8 * (4 * reach + a->reach + b->reach));
}

int main(void) {
    const char *folder = check_data_folder();
    object objects[FILES];
    int count = 0;
    for (int i = 0; folder && i < 1000 && count < FILES; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/compounds/%03d.obj", folder, i);
        FILE *f = fopen(path, "r");
        if (!f) continue;
        fclose(f);
        objects[count] = read_object(path);
        if (objects[count].compound)
            count++;
        else
            destroy_object(&objects[count]);
    }
    if (count == 0) {
        check_skip("no folder compounds in the data (OVOID_DATA)");
        return check_end();
    }
    printf("%d compounds\n", count);
    for (int i = 0; i < 400; i++) {
        uint64_t s = check_seed = 1 + (uint64_t)i;
        check_pair(&objects[random_next(&s) % (uint64_t)count], &objects[random_next(&s) % (uint64_t)count], &s);
    }
    for (int i = 0; i < count; i++) destroy_object(&objects[i]);
    return check_end();
}
