// Files of path proofs: a line for the source, then for each path a line with its answer and a line for each step.
// Cost: linear in the text; memory: of a source and a path.
#include "ovoid/robot_proof.h"

#include "robot/read/text/scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Longest line: a path of many states.
enum { LINE_MOST = 1 << 28, MASK_BITS = 8 };

struct ovoid_robot_proofs_reader {
    line_source lines;
    pool memory, names; ///< of the source; of the path's names
    ovoid_robot_proof_source source;
    size_t source_count, path_count; ///< paths of the source that were read
    ovoid_robot_step *steps;
    size_t step_capacity;
    double *states, *times;
    size_t state_capacity, time_capacity;
};

/// An array under construction.
typedef struct list {
    void *items;
    size_t count, capacity;
} list;

/// The state of reading a line.
typedef struct proof_reader {
    ovoid_robot_proofs_reader *file;
    scan s;
    ovoid_error *error;
} proof_reader;

static void *add(scan *s, list *l, size_t size) {
    if (!array_reserve(&l->items, &l->capacity, l->count, size)) return s->is_memory_out = 1, scan_fail(s, ""), NULL;
    return (char *)l->items + size * l->count++;
}

// The array in the pool; its own memory is freed.
static const void *keep(scan *s, list *l, size_t size) {
    void *kept = pool_get(s->memory, l->count + 1, size);
    if (!kept) s->is_memory_out = 1, scan_fail(s, "");
    if (kept && l->count) memcpy(kept, l->items, l->count * size);
    free(l->items);
    return kept;
}

// 1 where one more item of an array follows; the brackets are taken.
static int is_next(scan *s, size_t count) {
    if (count == 0) scan_take(s, '[');
    if (s->what || scan_try(s, ']')) return 0;
    if (count) scan_take(s, ',');
    return !s->what;
}

// ---- the source

static const char *const *take_texts(scan *s, size_t *count) {
    list texts = {NULL, 0, 0};
    while (is_next(s, texts.count)) {
        const char **text = add(s, &texts, sizeof *text);
        if (text) *text = scan_text(s);
    }
    *count = texts.count;
    return keep(s, &texts, sizeof(char *));
}

static ovoid_robot_proof_side take_side(scan *s) {
    ovoid_robot_proof_side side = {NULL, NULL, NULL, 0};
    scan_take(s, '{');
    if (scan_try_key(s, "link", 1)) {
        side.link = scan_text(s);
        scan_take_key(s, "element", 0);
        side.number = (uint32_t)scan_whole(s, UINT32_MAX);
        if (scan_try_key(s, "name", 0)) side.name = scan_text(s);
    } else {
        scan_take_key(s, "obstacle", 1);
        side.obstacle = scan_text(s);
        scan_take_key(s, "part", 0);
        side.number = (uint32_t)scan_whole(s, UINT32_MAX);
    }
    scan_take(s, '}');
    return side;
}

static void take_pairs(scan *s, ovoid_robot_proof_source *source) {
    list sides = {NULL, 0, 0};
    for (; is_next(s, sides.count); source->pair_count++) {
        scan_take(s, '[');
        for (int i = 0; i < 2; i++) {
            ovoid_robot_proof_side *side = add(s, &sides, sizeof *side);
            if (side) *side = take_side(s);
            scan_take(s, i ? ']' : ',');
        }
    }
    source->pairs = keep(s, &sides, sizeof *source->pairs);
}

// Sixteen digits.
static uint64_t take_digest(scan *s) {
    static const char digits[] = "0123456789abcdef";
    const char *text = scan_text(s);
    uint64_t value = 0;
    size_t i = 0;
    for (; i < 16 && text[i] && strchr(digits, text[i]); i++)
        value = value << 4 | (uint64_t)(strchr(digits, text[i]) - digits);
    if (i != 16 || text[16]) scan_fail(s, "the digest has not 16 digits");
    return value;
}

static void take_source(scan *s, ovoid_robot_proof_source *source) {
    if (scan_whole(s, 2) != 2) scan_fail(s, "the form of the proofs is not 2: they were written by another version");
    scan_take_key(s, "robot", 0), source->robot = scan_text(s);
    scan_take_key(s, "srdf", 0), source->srdf = scan_text_or_null(s);
    scan_take_key(s, "scene", 0), source->scene = scan_text_or_null(s);
    scan_take_key(s, "packages", 0), source->packages = take_texts(s, &source->package_count);
    scan_take_key(s, "scales", 0), source->scales = take_texts(s, &source->scale_count);
    scan_take_key(s, "paddings", 0), source->paddings = take_texts(s, &source->padding_count);
    scan_take_key(s, "parts", 0), source->parts = scan_flag(s);
    scan_take_key(s, "hull", 0), source->hull = scan_flag(s);
    scan_take_key(s, "visual", 0), source->visual = scan_flag(s);
    scan_take_key(s, "fixed_base", 0), source->fixed_base = scan_flag(s);
    scan_take_key(s, "cylinder_tolerance", 0), source->tolerance = scan_number(s);
    scan_take_key(s, "margin", 0), source->margin = scan_number(s);
    scan_take_key(s, "limit_slack", 0), source->limit_slack = scan_number(s);
    scan_take_key(s, "paths", 0), source->path_count = (size_t)scan_whole(s, (uint64_t)1 << 52);
    scan_take_key(s, "digest", 0), source->digest = take_digest(s);
    scan_take_key(s, "variables", 0), source->variables = take_texts(s, &source->variable_count);
    scan_take_key(s, "pairs", 0), take_pairs(s, source);
    scan_take(s, '}');
    scan_end(s);
}

// ---- a path

static ovoid_robot_status take_status(scan *s) {
    static const char *const names[] = {"undecided", "free", "hit", "refused"};
    const char *text = scan_text(s);
    for (int i = 0; i < 4; i++)
        if (strcmp(text, names[i]) == 0) return (ovoid_robot_status)i;
    scan_fail(s, "there is no such status");
    return OVOID_ROBOT_UNDECIDED;
}

static void take_pair(scan *s, ovoid_robot_proof *p) {
    scan_take_key(s, "segment", 0), p->segment = (size_t)scan_whole(s, OVOID_ROBOT_PATH_STATES_MAX);
    scan_take_key(s, "pair", 0), p->pair = (uint32_t)scan_whole(s, UINT32_MAX);
    scan_take_key(s, "a", 0), p->a = take_side(s);
    scan_take_key(s, "b", 0), p->b = take_side(s);
    scan_take_key(s, "lower", 0), p->answer.hit.lower = scan_number_or(s, -INFINITY);
    scan_take_key(s, "upper", 0), p->answer.hit.upper = scan_number_or(s, INFINITY);
}

static void take_answer(scan *s, ovoid_robot_proof *p) {
    ovoid_robot_path_answer *a = &p->answer;
    scan_take_key(s, "status", 0), a->status = a->hit.status = take_status(s);
    scan_take_key(s, "states", 0), p->count = (size_t)scan_whole(s, OVOID_ROBOT_PATH_STATES_MAX);
    scan_take_key(s, "margin", 0), p->margin = scan_number(s);
    if (a->status == OVOID_ROBOT_REFUSED) {
        scan_take_key(s, "refused", 0), a->refused = (size_t)scan_whole(s, OVOID_ROBOT_PATH_STATES_MAX);
        scan_take_key(s, "code", 0), (void)scan_text(s);
        scan_take_key(s, "variable", 0), (void)scan_text(s);
    } else {
        scan_take_key(s, "free_until", 0), a->free_until = scan_number(s);
        if (scan_try_key(s, "free_until_time", 0)) p->free_until_time = scan_number(s);
    }
    if (a->status == OVOID_ROBOT_HIT) {
        scan_take_key(s, "hit_at", 0), a->hit_at = scan_number(s);
        if (scan_try_key(s, "hit_at_time", 0)) p->hit_at_time = scan_number(s);
    }
    // Where a path was given up before a pair was measured, none is named.
    p->has_pair = a->status == OVOID_ROBOT_HIT || (a->status == OVOID_ROBOT_UNDECIDED && scan_is_key(s, "segment"));
    if (p->has_pair) take_pair(s, p);
    scan_take_key(s, "looked_at", 0), a->states = (uint32_t)scan_whole(s, UINT32_MAX);
    scan_take_key(s, "steps", 0), a->step_count = (size_t)scan_whole(s, UINT32_MAX);
}

// All numbers of the states, one after another.
static void take_states(proof_reader *r, ovoid_robot_proof *p) {
    ovoid_robot_proofs_reader *f = r->file;
    scan *s = &r->s;
    list all = {f->states, 0, f->state_capacity};
    scan_take_key(s, "q", 0);
    size_t count = 0;
    for (; is_next(s, count); count++) {
        size_t k = 0;
        for (; is_next(s, k); k++) {
            double *value = add(s, &all, sizeof *value);
            if (value) *value = scan_number(s);
        }
        if (k != f->source.variable_count) scan_fail(s, "a state has not as many numbers as there are variables");
    }
    if (count != p->count || count == 0) scan_fail(s, "there are not as many states as it says");
    f->states = all.items;
    f->state_capacity = all.capacity;
    p->states = f->states;
}

static void take_times(proof_reader *r, ovoid_robot_proof *p) {
    ovoid_robot_proofs_reader *f = r->file;
    scan *s = &r->s;
    list all = {f->times, 0, f->time_capacity};
    if (!scan_try_key(s, "times", 0)) return;
    while (is_next(s, all.count)) {
        double *value = add(s, &all, sizeof *value);
        if (value) *value = scan_number(s);
    }
    if (all.count != p->count) scan_fail(s, "there are not as many times as states");
    f->times = all.items;
    f->time_capacity = all.capacity;
    p->times = f->times;
}

// ---- a step

static uint16_t take_kind(scan *s) {
    static const char *const names[] = {"outer", "middle", "ends", "solid"};
    const char *text = scan_text(s);
    for (int i = 0; i < 4; i++)
        if (strcmp(text, names[i]) == 0) return (uint16_t)(i + 1);
    scan_fail(s, "there is no such kind of step");
    return OVOID_ROBOT_STEP_OUTER;
}

static ovoid_robot_step take_step(scan *s) {
    ovoid_robot_step step = {.pair = 0};
    scan_take(s, '{');
    scan_take_key(s, "step", 1), step.kind = take_kind(s);
    scan_take_key(s, "begin", 0), step.begin = scan_number(s);
    scan_take_key(s, "end", 0), step.end = scan_number(s);
    if (step.kind == OVOID_ROBOT_STEP_MIDDLE || step.kind == OVOID_ROBOT_STEP_ENDS) {
        double v[3];
        scan_take_key(s, "normal", 0);
        for (int i = 0; i < 3; i++) scan_take(s, i ? ',' : '['), v[i] = scan_number(s);
        scan_take(s, ']');
        step.normal = (ovoid_vec3){v[0], v[1], v[2]};
    }
    scan_take_key(s, "pairs", 0);
    size_t count = 0;
    for (uint32_t last = 0; is_next(s, count); count++) {
        uint32_t pair = (uint32_t)scan_whole(s, UINT32_MAX);
        if (count == 0) step.pair = pair;
        if ((count && pair <= last) || pair - step.pair >= MASK_BITS)
            scan_fail(s, "a step is of up to eight pairs, their numbers ascending and less than eight apart");
        if (!s->what) step.mask = (uint16_t)(step.mask | 1u << (pair - step.pair));
        last = pair;
    }
    if (!count) scan_fail(s, "a step is of no pair");
    scan_take(s, '}');
    scan_end(s);
    return step;
}

// ---- lines

static ovoid_code report(const proof_reader *r) {
    const ovoid_robot_proofs_reader *f = r->file;
    const scan *s = &r->s;
    if (s->is_memory_out) return io_fail_memory(r->error, f->lines.path);
    // A failure without a blank is a key that is not there.
    where at = {f->lines.path, f->lines.line, -1};
    if (strchr(s->what, ' '))
        return io_fail(r->error, OVOID_ERROR_FORMAT, at, "no line of path proofs, before \"%.*s\": %s",
                       (int)(s->end - s->at < 20 ? s->end - s->at : 20), s->at, s->what);
    return io_fail(r->error, OVOID_ERROR_FORMAT, at, "no line of path proofs: \"%s\" is missing, or not in its place",
                   s->what);
}

// The next line; 0 at the end, -1: *error is filled.
static int next_line(proof_reader *r, pool *memory) {
    const char *line = NULL;
    size_t length = 0;
    int got = line_source_next(&r->file->lines, &line, &length, r->error);
    if (got > 0) r->s = (scan){.at = line, .end = line + length, .memory = memory};
    return got;
}

// The steps behind an answer. 1, or -1 with the error filled.
static int read_steps(proof_reader *r, ovoid_robot_proof *p) {
    ovoid_robot_proofs_reader *f = r->file;
    size_t count = p->answer.step_count;
    list all = {f->steps, 0, f->step_capacity};
    int got = 1;
    for (size_t i = 0; i < count && got > 0; i++) {
        got = next_line(r, &f->names);
        if (got == 0) {
            where at = {f->lines.path, f->lines.line, -1};
            got = -1;
            (void)io_fail(r->error, OVOID_ERROR_FORMAT, at, "it ends after %zu of %zu steps: it was cut off", i, count);
        }
        if (got < 0) break;
        ovoid_robot_step step = take_step(&r->s), *place = add(&r->s, &all, sizeof step);
        if (place) *place = step;
        if (r->s.what) (void)report(r), got = -1;
    }
    f->steps = all.items;
    f->step_capacity = all.capacity;
    p->steps = f->steps;
    return got;
}

static void read_path(proof_reader *r, ovoid_robot_proof *p) {
    ovoid_robot_proofs_reader *f = r->file;
    p->source = f->source_count - 1;
    p->line = f->lines.line;
    scan_take_key(&r->s, "path", 1);
    p->number = (size_t)scan_whole(&r->s, (uint64_t)1 << 52);
    if (p->number != f->path_count || p->number >= f->source.path_count)
        scan_fail(&r->s, "the paths are not numbered 0, 1, 2, ..., or there are more than were announced");
    f->path_count++;
    take_answer(&r->s, p);
    take_states(r, p);
    take_times(r, p);
    scan_take(&r->s, '}');
    scan_end(&r->s);
}

static void read_source(proof_reader *r) {
    ovoid_robot_proofs_reader *f = r->file;
    pool_clear(&f->memory);
    f->source = (ovoid_robot_proof_source){.robot = NULL};
    f->source_count++;
    f->path_count = 0;
    r->s.memory = &f->memory;
    take_source(&r->s, &f->source);
}

// Where a source ends: 0, or -1 with the error filled.
static int validate_paths(const proof_reader *r) {
    const ovoid_robot_proofs_reader *f = r->file;
    if (f->path_count == f->source.path_count) return 0;
    where at = {f->lines.path, f->lines.line, -1};
    (void)io_fail(r->error, OVOID_ERROR_FORMAT, at, "there are %zu of %zu paths: it was cut off", f->path_count,
                  f->source.path_count);
    return -1;
}

int ovoid_robot_proofs_reader_read(ovoid_robot_proofs_reader *f, ovoid_robot_proof *p, ovoid_error *error) {
    proof_reader r = {.file = f, .error = error};
    *p = (ovoid_robot_proof){.answer = {.hit_at = INFINITY}, .free_until_time = NAN, .hit_at_time = NAN};
    for (;;) {
        pool_clear(&f->names);
        int got = next_line(&r, &f->names);
        if (got == 0) return validate_paths(&r);
        if (got < 0) return got;
        scan_take(&r.s, '{');
        int is_source = scan_try_key(&r.s, "path_proofs", 1);
        if (is_source && validate_paths(&r) < 0) return -1;
        if (is_source)
            read_source(&r);
        else if (!f->source_count)
            scan_fail(&r.s, "the first line does not say which robot and obstacles the proofs are of");
        else
            read_path(&r, p);
        if (r.s.what) return (void)report(&r), -1;
        if (!is_source) return read_steps(&r, p);
    }
}

// ---- the file

ovoid_robot_proofs_reader *ovoid_robot_proofs_reader_open(const char *path, ovoid_error *error) {
    ovoid_robot_proofs_reader *f = calloc(1, sizeof *f);
    if (!f) return (void)io_fail_memory(error, path), NULL;
    if (line_source_open(&f->lines, path, error) != OVOID_OK) return free(f), NULL;
    f->lines.most = LINE_MOST;
    return f;
}

void ovoid_robot_proofs_reader_close(ovoid_robot_proofs_reader *f) {
    if (!f) return;
    line_source_close(&f->lines);
    pool_clear(&f->memory);
    pool_clear(&f->names);
    free(f->steps);
    free(f->states);
    free(f->times);
    free(f);
}

const ovoid_robot_proof_source *ovoid_robot_proofs_reader_get_source(const ovoid_robot_proofs_reader *f) {
    return f->source_count ? &f->source : NULL;
}

int64_t ovoid_robot_proofs_reader_get_line(const ovoid_robot_proofs_reader *f) { return f->lines.line; }
