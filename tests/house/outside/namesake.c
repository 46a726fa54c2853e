// What a host might do with the library, its answers printed with all their digits: a hull, a distance, a depth, a
// world's frame. Exit 0 where the hull has the vertices that it must have: points on a sphere are all extreme, points
// within are not.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

enum { ON_SPHERE = 200, WITHIN = 300, BODIES = 60 };

static void fill_points(double (*points)[3]) {
    for (int i = 0; i < ON_SPHERE + WITHIN; i++) {
        double z = 1 - (2 * (i % ON_SPHERE) + 1) / (double)ON_SPHERE, r = sqrt(1 - z * z), turn = 2.399963 * i;
        double scale = i < ON_SPHERE ? 1 : 0.5;
        points[i][0] = scale * r * cos(turn);
        points[i][1] = scale * r * sin(turn);
        points[i][2] = scale * z;
    }
}

static void print_answer(const char *question, const ovoid_pair *pair, ovoid_answer answer) {
    int code = (int)ovoid_answer_verify(pair, &answer, NULL, NULL);
    printf("%s %d %.17g %.17g, proof %d\n", question, (int)answer.status, answer.lower, answer.upper, code);
}

static int print_contacts(const ovoid_shape *shape) {
    ovoid_world *world = ovoid_world_create(&(ovoid_world_options){.threads = 2}, NULL);
    if (!world) return 2;
    for (int i = 0; i < BODIES; i++) {
        ovoid_world_body body = {.body.shape = shape,
                                 .body.pose = {{i % 4 * 1.9, i / 4 % 4 * 1.9, i / 16 * 1.9}, {1, 0.1 * i, 0.2, 0}}};
        ovoid_world_add(world, &body, NULL);
    }
    ovoid_contacts contacts;
    ovoid_code code =
        ovoid_world_compute_contacts(world, &(ovoid_contact_query){.kind = OVOID_QUERY_DISTANCE}, &contacts, NULL);
    if (code == OVOID_OK) printf("%zu contacts of %zu bodies\n", contacts.count, ovoid_world_get_count(world));
    ovoid_world_destroy(world);
    return code == OVOID_OK ? 0 : 3;
}

int main(void) {
    static double points[ON_SPHERE + WITHIN][3];
    fill_points(points);
    ovoid_shape *shape = ovoid_shape_create_from_points(points[0], ON_SPHERE + WITHIN, NULL, NULL);
    if (!shape) return 1;
    ovoid_polytope hull = ovoid_shape_get_polytope(shape);
    printf("hull of %u vertices, %u facets\n", (unsigned)hull.vertex_count, (unsigned)hull.facet_count);
    int extreme = hull.vertex_count == ON_SPHERE;
    ovoid_pair apart = {shape, shape, {{0, 0, 0}, {1, 0, 0, 0}}, {{2.5, 0.3, 0.1}, {1, 0.2, 0, 0.4}}};
    print_answer("distance", &apart, ovoid_distance(&apart, NULL, NULL));
    ovoid_pair deep = {shape, shape, {{0, 0, 0}, {1, 0, 0, 0}}, {{1.2, 0.3, 0.1}, {1, 0.2, 0, 0.4}}};
    ovoid_answer depth = ovoid_depth(&deep, NULL, NULL, NULL);
    printf("depth %d %.17g %.17g\n", (int)depth.status, depth.lower, depth.upper);
    int code = print_contacts(shape);
    ovoid_shape_destroy(shape);
    return extreme ? code : 4;
}
