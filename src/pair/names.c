// The names of statuses, stages, limits and kinds of proofs.
#include "ovoid/query.h"

const char *ovoid_status_get_name(ovoid_status status) {
    switch (status) {
    case OVOID_UNDECIDED: return "undecided";
    case OVOID_SEPARATED: return "separated";
    case OVOID_TOUCHING: return "touching";
    case OVOID_OVERLAPPING: return "overlapping";
    }
    return "unknown";
}

const char *ovoid_stage_get_name(ovoid_stage stage) {
    switch (stage) {
    case OVOID_STAGE_NONE: return "none";
    case OVOID_STAGE_PROOF: return "proof";
    case OVOID_STAGE_SPHERE: return "sphere";
    case OVOID_STAGE_OUTER: return "outer";
    case OVOID_STAGE_SUPPORT: return "support";
    case OVOID_STAGE_INNER: return "inner";
    case OVOID_STAGE_GJK: return "gjk";
    case OVOID_STAGE_EPA: return "epa";
    case OVOID_STAGE_REFINE: return "refine";
    }
    return "unknown";
}

const char *ovoid_limit_get_name(ovoid_limit limit) {
    switch (limit) {
    case OVOID_LIMIT_NONE: return "none";
    case OVOID_LIMIT_ANSWERED: return "answered";
    case OVOID_LIMIT_CAP: return "cap";
    case OVOID_LIMIT_ITERATIONS: return "iterations";
    case OVOID_LIMIT_PRECISION: return "precision";
    case OVOID_LIMIT_CAPACITY: return "capacity";
    case OVOID_LIMIT_POSE_A: return "pose_a";
    case OVOID_LIMIT_POSE_B: return "pose_b";
    case OVOID_LIMIT_OPTIONS: return "options";
    case OVOID_LIMIT_SHAPE_A: return "shape_a";
    case OVOID_LIMIT_SHAPE_B: return "shape_b";
    case OVOID_LIMIT_ALLOWANCE: return "allowance";
    case OVOID_LIMIT_MEMORY: return "memory";
    }
    return "unknown";
}

const char *ovoid_proof_kind_get_name(ovoid_proof_kind kind) {
    switch (kind) {
    case OVOID_PROOF_NONE: return "none";
    case OVOID_PROOF_POINTS: return "points";
    case OVOID_PROOF_HULL: return "hull";
    case OVOID_PROOF_INNER: return "inner";
    case OVOID_PROOF_INNER_POINTS: return "inner_points";
    case OVOID_PROOF_BALLS: return "balls";
    case OVOID_PROOF_COVER: return "cover";
    }
    return "unknown";
}
