// The kernel that moves eight bodies, bit for bit: that of each instruction set against its scalar twin, and the twin
// against a body moved by the words of world/move.c, written out here. No tolerance. test_world_moves.c compares whole
// worlds.
#include "simd/move8.h"

#include "check.h"
#include "linear/rotation.h"
#include "ovoid/ovoid.h"

enum { ROUNDS = 2000 };

#define SLACK (1 + 0x1p-48)
#define NEARLY_UNIT 0x1p-40
#define CENTER 0x1p-46

static const move8_errors errors = {SLACK, NEARLY_UNIT, CENTER, OVOID_LENGTH_MIN};

typedef struct moving {
    ovoid_pose from, to;
    double ball[4], reach[4], place[4], placed[4];
    float room[6];
} moving;

static moving bodies[PAIR8];
static move8_places places;

static ovoid_quat make_unit(uint64_t *s) {
    ovoid_quat q = {random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1), 0.5};
    double n = 1 / sqrt(quat_norm_squared(q));
    return (ovoid_quat){q.w * n, q.x * n, q.y * n, q.z * n};
}

// A body that turns and moves a little, stays, comes with the other sign, jumps, or has a quaternion of another length.
static void fill(uint64_t *s, moving *m) {
    double step = random_next(s) % 8 ? 0.01 : 3;
    m->from.rotation = make_unit(s);
    m->to.rotation = make_unit(s);
    if (random_next(s) % 4) m->to.rotation = m->from.rotation;
    if (random_next(s) % 4 == 0)
        m->to.rotation = (ovoid_quat){-m->to.rotation.w, -m->to.rotation.x, -m->to.rotation.y, -m->to.rotation.z};
    if (random_next(s) % 16 == 0) m->to.rotation.w += 1e-3;
    if (random_next(s) % 16 == 0) m->from.rotation.z += 1e-3;
    for (int i = 0; i < 4; i++) {
        m->ball[i] = random_uniform(s, 0, 1);
        m->reach[i] = random_uniform(s, 0, 1);
        m->place[i] = random_uniform(s, 0, 2);
        m->placed[i] = m->place[i] - random_uniform(s, 0, step);
    }
    m->reach[2] *= 0x1p-45;
    double *p = &m->from.position.x, *q = &m->to.position.x;
    int stays = random_next(s) % 3 == 0;
    for (int i = 0; i < 3; i++) {
        p[i] = random_uniform(s, -10, 10);
        q[i] = stays ? p[i] : p[i] + random_uniform(s, -step, step);
        m->room[i] = m->room[3 + i] = (float)random_uniform(s, 0, 40);
    }
}

static double chord_of(ovoid_quat p, ovoid_quat q) {
    if (p.w == q.w && p.x == q.x && p.y == q.y && p.z == q.z) return 0;
    double sign = (p.w * q.w + p.x * q.x) + (p.y * q.y + p.z * q.z) < 0 ? -1 : 1;
    ovoid_quat e = {q.w - sign * p.w, q.x - sign * p.x, q.y - sign * p.y, q.z - sign * p.z};
    return min2(2 * sqrt(quat_norm_squared(e)) * SLACK + 2 * NEARLY_UNIT, 2);
}

static void check_same(double found, double right) {
    if (memcmp(&found, &right, sizeof right) != 0) CHECK_EQ(found, right);
}

static uint64_t seen[4]; // moved, left, odd, stayed in its box

static void check_lane(const move8_result *r, unsigned k) {
    const moving *m = &bodies[k];
    int is_odd = !(fabs(quat_norm_squared(m->from.rotation) - 1) < NEARLY_UNIT &&
                   fabs(quat_norm_squared(m->to.rotation) - 1) < NEARLY_UNIT);
    CHECK_EQ(r->odd >> k & 1, is_odd);
    seen[2] += (uint64_t)is_odd;
    if (is_odd) return;
    double chord = chord_of(m->from.rotation, m->to.rotation);
    int has_moved = chord > 0 || memcmp(&m->from.position, &m->to.position, sizeof m->to.position) != 0;
    CHECK_EQ(r->moved >> k & 1, has_moved);
    vec3 local = {m->ball[0], m->ball[1], m->ball[2]};
    vec3 at = vec3_add(m->to.position, mat3_mul_vec3(quat_to_mat3(m->to.rotation), local));
    double error = CENTER * (vec3_max_abs(m->to.position) + m->ball[3]) + OVOID_LENGTH_MIN;
    double turn = (chord * m->reach[0] + (m->reach[2] + error)) * SLACK, travel = m->place[3] + turn;
    travel += travel * 0x1p-51;
    int is_in = 1;
    for (int i = 0; i < 3; i++) {
        double way = vec3_get(at, i) - m->placed[i], turned = travel - m->placed[3];
        double slack = turned + 0x1p-48 * (fabs(way) + turned);
        is_in &= way + slack <= (double)m->room[3 + i] && slack - way <= (double)m->room[i];
        check_same(r->place[i].lane[k], vec3_get(at, i));
        check_same(r->displacement[i].lane[k], vec3_get(at, i) - m->place[i]);
    }
    check_same(r->place[3].lane[k], travel);
    check_same(r->turn.lane[k], turn);
    check_same(r->center_error.lane[k], error);
    CHECK_EQ(r->left >> k & 1, has_moved && !is_in);
    seen[0] += (uint64_t)has_moved;
    seen[1] += (uint64_t)(has_moved && !is_in);
    seen[3] += (uint64_t)(has_moved && is_in);
}

static void check_twin(const move8_result *right, move8_function *kernel) {
    move8_result found;
    kernel(&places, &errors, &found);
    CHECK_EQ(found.odd, right->odd);
    CHECK_EQ(found.moved, right->moved);
    CHECK_EQ(found.left, right->left);
    for (size_t i = 0; i < offsetof(move8_result, moved) / sizeof(lane_column); i++)
        for (unsigned k = 0; k < places.count; k++)
            if (!(right->odd >> k & 1))
                check_same(((lane_column *)&found)[i].lane[k], ((const lane_column *)right)[i].lane[k]);
}

int main(void) {
    uint64_t s = 23;
    for (int round = 0; round < ROUNDS; round++) {
        check_seed = (uint64_t)round;
        places.count = 1 + (unsigned)round % PAIR8;
        for (unsigned k = 0; k < PAIR8; k++) {
            fill(&s, &bodies[k]);
            const moving *m = &bodies[k < places.count ? k : 0];
            places.from[k] = &m->from.position.x;
            places.to[k] = &m->to.position.x;
            places.ball[k] = m->ball;
            places.reach[k] = m->reach;
            places.place[k] = m->place;
            places.placed[k] = m->placed;
            places.room[k] = m->room;
        }
        move8_result right;
        move8_get_of(SIMD_SCALAR)(&places, &errors, &right);
        for (unsigned k = 0; k < places.count; k++) check_lane(&right, k);
        for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++)
            if (move8_get_of(isa)) check_twin(&right, move8_get_of(isa));
        check_twin(&right, move8_get(places.count));
    }
    for (int i = 0; i < 4; i++) CHECK(seen[i] > 300);
    return check_end();
}
