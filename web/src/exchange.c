// The numbers that the module and its caller pass each other.
#include "src/exchange.h"

#include <stdlib.h>

double exchange[EXCHANGE_COUNT];
ovoid_error exchange_error;

const double *read_vec3(const double *from, ovoid_vec3 *v) {
    *v = (ovoid_vec3){from[0], from[1], from[2]};
    return from + 3;
}

const double *read_pose(const double *from, ovoid_pose *pose) {
    from = read_vec3(from, &pose->position);
    pose->rotation = (ovoid_quat){from[0], from[1], from[2], from[3]};
    return from + 4;
}

double *write_vec3(double *to, ovoid_vec3 v) {
    to[0] = v.x, to[1] = v.y, to[2] = v.z;
    return to + 3;
}

double *write_sym3(double *to, ovoid_sym3 m) {
    to[0] = m.xx, to[1] = m.xy, to[2] = m.xz, to[3] = m.yy, to[4] = m.yz, to[5] = m.zz;
    return to + 6;
}

double *write_pose(double *to, const ovoid_pose *pose) {
    to = write_vec3(to, pose->position);
    to[0] = pose->rotation.w, to[1] = pose->rotation.x, to[2] = pose->rotation.y, to[3] = pose->rotation.z;
    return to + 4;
}

double *write_answer(double *to, const ovoid_answer *a) {
    *to++ = a->status, *to++ = a->stage, *to++ = a->limit, *to++ = a->iterations, *to++ = a->lower, *to++ = a->upper;
    return write_vec3(write_vec3(write_vec3(to, a->point_a), a->point_b), a->normal);
}

const double *read_answer(const double *from, ovoid_answer *a) {
    a->status = (ovoid_status)*from++;
    a->stage = (ovoid_stage)*from++;
    a->limit = (ovoid_limit)*from++;
    a->iterations = (uint32_t)*from++;
    a->lower = *from++, a->upper = *from++;
    return read_vec3(read_vec3(read_vec3(from, &a->point_a), &a->point_b), &a->normal);
}

double *write_proof(double *to, const ovoid_proof *p) {
    to = write_vec3(write_vec3(to, p->normal), p->normal_low);
    *to++ = p->kind, *to++ = p->count;
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        *to++ = p->a[i], *to++ = p->b[i];
        *to++ = p->weight_a[i], *to++ = p->weight_b[i];
    }
    return write_vec3(write_vec3(to, p->inner_a), p->inner_b);
}

uint32_t read_index(double x) { return x >= 0 && x < 4294967295.0 ? (uint32_t)x : UINT32_MAX; }

const double *read_proof(const double *from, ovoid_proof *p) {
    from = read_vec3(read_vec3(from, &p->normal), &p->normal_low);
    p->kind = (ovoid_proof_kind)(read_index(*from++) & 0xff);
    p->count = read_index(*from++);
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        p->a[i] = read_index(*from++), p->b[i] = read_index(*from++);
        p->weight_a[i] = *from++, p->weight_b[i] = *from++;
    }
    return read_vec3(read_vec3(from, &p->inner_a), &p->inner_b);
}

const double *read_options(const double *from, ovoid_options *o) {
    *o = (ovoid_options){.absolute_tolerance = from[0], .relative_tolerance = from[1], .cap = from[2]};
    o->iterations = from[3] >= 0 && from[3] <= 1e9 ? (uint32_t)from[3] : 1;
    return from + 4;
}

// ---- memory and errors

void *EXPORT(allocate)(size_t size) { return malloc(size ? size : 1); }
void EXPORT(release)(void *memory) { free(memory); }
double *EXPORT(get_exchange)(void) { return exchange; }
const char *EXPORT(get_error_message)(void) { return exchange_error.message; }
int EXPORT(get_error_code)(void) { return (int)exchange_error.code; }
double EXPORT(get_error_place)(void) { return (double)exchange_error.place; }
const char *EXPORT(get_version)(void) { return ovoid_get_version(); }

// ---- words

const char *EXPORT(get_status_name)(int i) { return ovoid_status_get_name((ovoid_status)i); }
const char *EXPORT(get_stage_name)(int i) { return ovoid_stage_get_name((ovoid_stage)i); }
const char *EXPORT(get_limit_name)(int i) { return ovoid_limit_get_name((ovoid_limit)i); }
const char *EXPORT(get_proof_kind_name)(int i) { return ovoid_proof_kind_get_name((ovoid_proof_kind)i); }
