// Prints pairs and answers with 17 digits.
#include "report.h"

static void print_shape(FILE *f, const char *name, const ovoid_shape *shape, const ovoid_pose *pose) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    fprintf(f,
            "  %s: rank %u, radius %.17g, origin %.17g %.17g %.17g, position %.17g %.17g %.17g, wxyz %.17g %.17g %.17g "
            "%.17g\n",
            name, p.rank, ovoid_shape_get_radius(shape), p.origin.x, p.origin.y, p.origin.z, pose->position.x,
            pose->position.y, pose->position.z, pose->rotation.w, pose->rotation.x, pose->rotation.y, pose->rotation.z);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        fprintf(f, "   %.17g %.17g %.17g\n", v[0], v[1], v[2]);
    }
}

void print_pair(FILE *f, const ovoid_pair *pair) {
    print_shape(f, "A", pair->shape_a, &pair->pose_a);
    print_shape(f, "B", pair->shape_b, &pair->pose_b);
}

void print_answer(FILE *f, const ovoid_answer *x) {
    fprintf(f, "  %s by %s, limit %s, %u iterations, [%.17g, %.17g], proof %s of %u, normal %.17g %.17g %.17g\n",
            ovoid_status_get_name(x->status), ovoid_stage_get_name(x->stage), ovoid_limit_get_name(x->limit),
            x->iterations, x->lower, x->upper, ovoid_proof_kind_get_name(x->proof.kind), x->proof.count, x->normal.x,
            x->normal.y, x->normal.z);
    fprintf(f, "  low part of the normal %.17g %.17g %.17g\n", x->proof.normal_low.x, x->proof.normal_low.y,
            x->proof.normal_low.z);
    fprintf(f, "  points %.17g %.17g %.17g, %.17g %.17g %.17g\n", x->point_a.x, x->point_a.y, x->point_a.z,
            x->point_b.x, x->point_b.y, x->point_b.z);
}
