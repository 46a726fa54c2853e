// Checking a result by its proof alone, on its bodies, without any search.
#include "verify.h"

#include "pairs/answers.h"

#include <math.h>
#include <string.h>

/// 1 if point_b - point_a must be d times the normal: in answers to distance, not of ovoid_within, which are those of
/// impacts; not where a limit ended the search of a depth and the proof is a common point.
static int claims_points(const verify *v, const claim *item, const ovoid_answer *answer) {
    if (answer->proof.kind == OVOID_PROOF_HULL || answer->proof.kind == OVOID_PROOF_INNER) return 0;
    if (item->kind != CLAIM_RESULT || item->record.fields & OVOID_RECORD_IMPACT) return 0;
    return v->settings->query == QUERY_DISTANCE;
}

/// Finds the pair of parts of a record; 0 where there is none such.
static int get_parts(const ovoid_body_pair *bodies, const ovoid_record *record, ovoid_pair *pair) {
    const uint32_t parts[2] = {record->fields & OVOID_RECORD_PARTS ? record->part_a : OVOID_RECORD_NO_PART,
                               record->fields & OVOID_RECORD_PARTS ? record->part_b : OVOID_RECORD_NO_PART};
    return contacts_get_parts(bodies, parts, pair);
}

/// Checks the answer of compounds: that of the deciding parts, and that the exclusions hold and leave out no other pair
/// of parts. points: the deciding parts, whose witness points are checked too, or NULL.
static ovoid_code verify_compound(const verify *v, const claim *item, const ovoid_pair *points, ovoid_error *error) {
    const ovoid_record *r = &item->record;
    ovoid_body_answer answer = ovoid_body_answer_make(&r->answer, item->pair.a.compound ? r->part_a : 0,
                                                      item->pair.b.compound ? r->part_b : 0);
    ovoid_exclusions exclusions = {.items = (ovoid_exclusion *)r->exclusions,
                                   .capacity = r->exclusion_count,
                                   .count = r->exclusion_count,
                                   .cover = (ovoid_cover *)r->cover};
    return verdict_verify_compound(v->verdict, &item->pair, &answer, &exclusions, points, error);
}

ovoid_code verify_claim_impact(const claim *item, double margin, const ovoid_body_impact *found,
                               const ovoid_step *steps, const ovoid_step_group *groups, ovoid_error *error) {
    const ovoid_moving_body *a = &item->moving[0], *b = &item->moving[1];
    if (!a->shape || !b->shape || found->group_count)
        return ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, found,
                                        &(ovoid_motion_basis){.steps = steps, .groups = groups}, error);
    ovoid_moving_shape moving[2] = {ovoid_moving_body_get_part(a, 0), ovoid_moving_body_get_part(b, 0)};
    return ovoid_impact_verify(&(ovoid_moving_pair){moving[0], moving[1], margin}, &found->impact,
                               &(ovoid_motion_basis){.steps = steps}, error);
}

/// Checks an impact: the steps show that the pair was farther apart than the margin until then, and at the end it is
/// not; of one that is not proven, the steps alone.
static ovoid_code verify_impact(const claim *item, const ovoid_answer *answer, ovoid_error *error) {
    const ovoid_record *r = &item->record;
    if (!(r->fields & OVOID_RECORD_IMPACT)) return OVOID_OK;
    const ovoid_moving_body *a = &item->moving[0], *b = &item->moving[1];
    ovoid_body_impact found = {
        .part_a = a->compound ? r->part_a : 0, .part_b = b->compound ? r->part_b : 0, .group_count = r->group_count};
    int is_hit = isfinite(r->hit_after);
    found.impact = (ovoid_impact){.status = is_hit ? OVOID_IMPACT_HIT : OVOID_IMPACT_UNDECIDED,
                                  .limit = is_hit ? OVOID_LIMIT_NONE : r->answer.limit,
                                  .end = item->duration,
                                  .free_until = r->free_for,
                                  .hit_at = r->hit_after,
                                  .step_count = r->step_count,
                                  .hit = *answer};
    if (a->solid || b->solid) {
        // The parts of solids' records are those of the whole bodies' answer, which decides where the impact ends.
        found.part_a = r->solid ? r->solid->part_a : 0;
        found.part_b = r->solid ? r->solid->part_b : 0;
        found.impact.hit = r->solid ? r->solid->deciding : *answer;
    } else if (!a->compound && !b->compound) {
        // The distance at the end of the free time is not claimed, so it is queried here.
        ovoid_pair free = {a->shape, b->shape, ovoid_motion_compute_pose(&a->motion, r->free_for),
                           ovoid_motion_compute_pose(&b->motion, r->free_for)};
        found.impact.free = ovoid_within(&free, r->margin, NULL, NULL);
    }
    return verify_claim_impact(item, r->margin, &found, r->steps, r->groups, error);
}

/// The answer of solids is that of their surfaces, of which the points are, and what follows from it.
static ovoid_code verify_solids(const verify *v, const claim *item, ovoid_error *error) {
    const ovoid_record *r = &item->record;
    ovoid_exclusions exclusions = {
        .items = (ovoid_exclusion *)r->exclusions, .capacity = r->exclusion_count, .count = r->exclusion_count};
    if (!item->pair.a.solid && !item->pair.b.solid) {
        snprintf(error->message, sizeof error->message, "it is an answer about solids, which the bodies are not");
        return OVOID_ERROR_PROOF;
    }
    int points = claims_points(v, item, &r->solid->deciding);
    return verdict_verify_solid(v->verdict, &item->pair, r->solid, &exclusions, points, error);
}

static ovoid_code verify_answer(const verify *v, const claim *item, ovoid_error *error) {
    if (item->record.solid) {
        ovoid_code held = verify_solids(v, item, error);
        return held == OVOID_OK ? verify_impact(item, &item->record.answer, error) : held;
    }
    ovoid_pair pair;
    const ovoid_answer answer = item->record.answer;
    int is_compound = item->pair.a.compound || item->pair.b.compound;
    if (!get_parts(&item->pair, &item->record, &pair)) {
        snprintf(error->message, sizeof error->message, "the parts are not those of the bodies");
        return OVOID_ERROR_PROOF;
    }
    int points = claims_points(v, item, &answer);
    ovoid_code code = is_compound ? verify_compound(v, item, points ? &pair : NULL, error)
                                  : verdict_verify(v->verdict, &pair, &answer, item->record.cover, points, error);
    return code == OVOID_OK ? verify_impact(item, &answer, error) : code;
}

ovoid_code verify_claim(const verify *v, const claim *item, ovoid_error *error) {
    ovoid_code code = verify_answer(v, item, error);
    if (code != OVOID_OK || !(item->record.fields & OVOID_RECORD_CONTACTS)) return code;
    return contacts_verify(&item->pair, &item->record, v->settings->tolerance, error);
}
