// Brackets of both lengths: the ends of the searches are moved outward by the bound of rounding.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "decompose/searches.h"

static ovoid_decomposition_length make_length(const body *b, const cell_search *s, double upper) {
    // Underflow is covered by this: a bracket is never narrower.
    double lower = (s->lower - b->pad) * b->unit;
    return (ovoid_decomposition_length){
        .lower = max2(lower, 0),
        .upper = (upper + b->pad) * b->unit + OVOID_LENGTH_MIN,
        .point = vec3_scale(s->point, b->unit),
        .part = s->point_owner,
    };
}

static cell_search make_search(body *b, const ovoid_decomposition_options *o, cell *heap, size_t room) {
    double tolerance = o->tolerance > 0 ? o->tolerance * b->inverse : b->diagonal * 1e-3;
    return (cell_search){.problem = b,
                         .tolerance = max2(tolerance - 2 * b->pad, b->pad),
                         .ceiling = INFINITY,
                         .heap = heap,
                         .room = room,
                         .work = o->work,
                         .options = o};
}

static ovoid_code prove(body *b, const ovoid_decomposition_options *o, ovoid_decomposition_proof *proof,
                        ovoid_error *error) {
    double *excess = o->excesses;
    size_t room = o->cells, first = 6 * (size_t)b->part_count;
    if (room < first + CELL_PIECES) room = first + CELL_PIECES;
    cell *heap = allocator_allocate(&b->memory, room, sizeof *heap);
    if (!heap) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu cells", room);
    cell_search s = make_search(b, o, heap, room);
    proof->uncovered = make_length(b, &s, uncovered_search(&s));
    proof->cells = s.looked;
    s = make_search(b, o, heap, room);
    s.owners = excess;
    for (size_t i = 0; excess && i < b->part_count; i++) excess[i] = 0;
    proof->excess = make_length(b, &s, excess_search(&s));
    proof->cells += s.looked;
    for (size_t i = 0; excess && i < b->part_count; i++) excess[i] = (excess[i] + b->pad) * b->unit + OVOID_LENGTH_MIN;
    allocator_release(&b->memory, heap);
    return OVOID_OK;
}

static ovoid_code compute_proof(const ovoid_decomposition *d, const ovoid_decomposition_options *given,
                                ovoid_decomposition_proof *proof, ovoid_error *error) {
    ovoid_decomposition_options options;
    body b;
    if (!proof) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no place for the proof (NULL)");
    ovoid_code code = body_validate_options(given, &options, error);
    if (code == OVOID_OK) code = body_open_parts(&b, d, &options, error);
    if (code != OVOID_OK) return code;
    code = prove(&b, &options, proof, error);
    body_close(&b);
    return code;
}

ovoid_code ovoid_decomposition_compute_proof(const ovoid_decomposition *decomposition,
                                             const ovoid_decomposition_options *options,
                                             ovoid_decomposition_proof *proof, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, decomposition, compute_proof(decomposition, options, proof, error));
}
