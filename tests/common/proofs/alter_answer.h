// The fields of an answer with its proof, for tests that alter them (alter.h).
#ifndef OVOID_TESTS_ALTER_ANSWER_H
#define OVOID_TESTS_ALTER_ANSWER_H

#include "alter.h"
#include "ovoid/body.h"

#define ALTER_VEC3(member)                                                                                             \
    ALTER_FIELD(ovoid_answer, member.x, ALTER_REAL, 1e-9), ALTER_FIELD(ovoid_answer, member.y, ALTER_REAL, 1e-9),      \
        ALTER_FIELD(ovoid_answer, member.z, ALTER_REAL, 1e-9)
#define ALTER_PAIRS(member, type)                                                                                      \
    ALTER_FIELD(ovoid_answer, member[0], type, 1e-9), ALTER_FIELD(ovoid_answer, member[1], type, 1e-9),                \
        ALTER_FIELD(ovoid_answer, member[2], type, 1e-9), ALTER_FIELD(ovoid_answer, member[3], type, 1e-9),            \
        ALTER_FIELD(ovoid_answer, member[4], type, 1e-9), ALTER_FIELD(ovoid_answer, member[5], type, 1e-9)

/// All fields of an answer that claim something; stage and iterations only say how it was found.
static const alter_field alter_answer_fields[] = {ALTER_FIELD(ovoid_answer, status, ALTER_INT, 0),
                                                  ALTER_FIELD(ovoid_answer, limit, ALTER_INT, 0),
                                                  ALTER_FIELD(ovoid_answer, lower, ALTER_REAL, 1e-9),
                                                  ALTER_FIELD(ovoid_answer, upper, ALTER_REAL, 1e-9),
                                                  ALTER_VEC3(point_a),
                                                  ALTER_VEC3(point_b),
                                                  ALTER_VEC3(normal),
                                                  ALTER_VEC3(proof.normal),
                                                  ALTER_VEC3(proof.normal_low),
                                                  ALTER_FIELD(ovoid_answer, proof.kind, ALTER_INT, 0),
                                                  ALTER_FIELD(ovoid_answer, proof.count, ALTER_U32, 0),
                                                  ALTER_PAIRS(proof.a, ALTER_U32),
                                                  ALTER_PAIRS(proof.b, ALTER_U32),
                                                  ALTER_PAIRS(proof.weight_a, ALTER_REAL),
                                                  ALTER_PAIRS(proof.weight_b, ALTER_REAL),
                                                  ALTER_VEC3(proof.inner_a),
                                                  ALTER_VEC3(proof.inner_b)};
enum { ALTER_ANSWER_FIELDS = sizeof alter_answer_fields / sizeof *alter_answer_fields };

/// Alterations that are no change of one number: parts of the answer swapped, those of another answer, or values that
/// no enumeration has. 0: there is no such alteration, or it changes nothing.
enum { ALTER_ANSWER_FORGERIES = 10 };
static inline int alter_answer_forge(ovoid_answer *answer, const ovoid_answer *other, const uint32_t counts[2],
                                     int which) {
    const ovoid_answer before = *answer;
    ovoid_vec3 kept = answer->point_a;
    switch (which) {
    case 0: answer->point_a = answer->point_b, answer->point_b = kept; break;
    case 1: answer->proof = other->proof; break;
    case 2: answer->proof = other->proof, answer->normal = other->normal; break;
    case 3: answer->proof.a[answer->proof.count ? answer->proof.count - 1 : 0] = counts[0]; break;
    case 4: answer->proof.b[0] = counts[1]; break;
    case 5: answer->proof.count = OVOID_PROOF_PAIRS + 1; break;
    case 6:
        answer->normal = (ovoid_vec3){-answer->normal.x, -answer->normal.y, -answer->normal.z},
        answer->proof.normal = answer->normal;
        break;
    case 7: answer->lower = other->lower, answer->upper = other->upper, answer->status = other->status; break;
    case 8:
        answer->status = OVOID_TOUCHING, answer->lower = fmin(answer->lower, -1e-7),
        answer->upper = fmax(answer->upper, 1e-7);
        break;
    default: answer->limit = OVOID_LIMIT_NONE, answer->lower -= 1 + fabs(answer->lower); break;
    }
    return memcmp(&before, answer, sizeof before) != 0;
}

/// 1 if the limit claims a width that the bracket does not have, or a distance beyond a cap that it does not prove.
/// most: at least the tolerance for these bodies; wide: at least the width that their allowances add.
static inline int alter_limit_is_false(const ovoid_answer *answer, double most, double wide, double cap) {
    double width = answer->upper - answer->lower;
    if ((int)answer->limit < 0 || answer->limit > OVOID_LIMIT_ALLOWANCE) return 1;
    if (answer->limit == OVOID_LIMIT_NONE) return !(width <= most + wide);
    if (answer->limit == OVOID_LIMIT_ALLOWANCE) return !(wide > 0 && width <= most + 2 * wide);
    if (answer->limit == OVOID_LIMIT_CAP) return !(answer->lower > cap);
    return answer->limit >= OVOID_LIMIT_POSE_A && (answer->lower > -INFINITY || answer->upper < INFINITY);
}

#endif
