// Segments in blocks of eight lanes: the first block has intervals of all segments, and those that stay open are
// divided for the next one, which looks at open pairs alone. What is open after some blocks is the search's.
#include "robot/path/cover.h"

#include "base/compiler.h"
#include "base/watch.h"

#include <string.h>

// How many blocks one segment is given at most, how many more each other one, and how many open lanes a block holds
// after the first.
enum { BLOCKS_MOST = 5, BLOCKS_MORE = 2, OPEN_MOST = 4 };

// ---- segments

// What is remembered of pairs, if it was for a checker that has forgotten meanwhile.
static void forget(path_cover *c) {
    size_t count = path_count_numbers(c->w->cell);
    memset(c->normals, 0, count * sizeof *c->normals);
    memset(c->proofs, 0, count * sizeof *c->proofs);
    memset(c->hit_counts, 0, count);
}

void path_cover_begin(path_cover *c, const cover_query *query) {
    if (query->generation != c->query.generation) forget(c);
    c->query = *query;
    c->segment_count = c->set_segment = c->blocks = 0;
    c->level = 0;
    memset(c->speeds, 0, c->w->step_count * sizeof *c->speeds);
    memset(c->slides, 0, c->w->step_count * sizeof *c->slides);
    memset(c->slacks, 0, 2 * c->w->step_count * sizeof *c->slacks);
}

void path_cover_add(path_cover *c, const double *q0, const double *q1, uint32_t parts) {
    c->set_segment = c->segment_count;
    cover_segment *to = &c->segments[c->segment_count++];
    to->q0 = q0, to->q1 = q1;
    to->parts = parts;
    to->hit_at = INFINITY;
    to->is_open = 0;
    to->begin = 1, to->end = 0;
    memset(to->left, 0, c->mask_count);
    c->level = max2(c->level, c->w->level);
    cover_add_rates(c, to);
}

void path_cover_set(path_cover *c) {
    // Errors are those of the segment with the largest numbers.
    if (c->w->level < c->level) {
        path_set_level(c->w, c->level);
        c->set_segment = COVER_SEGMENTS;
    }
    cover_set_bounds(c);
    cover_renew_boxes(c);
}

// ---- lanes

static void add_part(cover_lanes *to, unsigned *at, uint32_t segment, const double ends[2]) {
    to->begin[*at] = ends[0], to->end[*at] = ends[1];
    to->segment[*at] = (uint8_t)segment;
    ++*at;
}

// Lanes that nothing uses repeat the first one.
static void fill_up(cover_lanes *to, unsigned at) {
    to->used = (1u << at) - 1;
    while (at < COVER8) add_part(to, &at, to->segment[0], (double[]){to->begin[0], to->end[0]});
}

// The intervals of all segments, in twice as many lanes each while there is room.
static void divide_segments(const path_cover *c, cover_lanes *to) {
    unsigned at = 0, sum = 0, scale = 1;
    for (uint32_t i = 0; i < c->segment_count; i++) sum += c->segments[i].parts;
    while (2 * scale * sum <= COVER8) scale *= 2;
    for (uint32_t i = 0; i < c->segment_count; i++) {
        uint32_t parts = scale * c->segments[i].parts;
        for (uint32_t k = 0; k < parts; k++)
            add_part(to, &at, i, (double[]){k / (double)parts, (k + 1) / (double)parts});
    }
    fill_up(to, at);
}

// Each lane of the mask in as many equal parts as there is room for; of[k]: the lane that lane k is a part of.
static void divide(const cover_lanes *from, unsigned mask, cover_lanes *to, unsigned of[COVER8]) {
    unsigned open = 0, lanes[OPEN_MOST], at = 0;
    for (; mask; mask &= mask - 1) lanes[open++] = compiler_count_low_zeros(mask);
    unsigned parts = open == 1 ? 8 : open == 2 ? 4 : 2;
    for (unsigned k = 0; k < open; k++) {
        double begin = from->begin[lanes[k]], width = (from->end[lanes[k]] - begin) / parts;
        for (unsigned i = 0; i < parts; i++) {
            of[at] = lanes[k];
            add_part(to, &at, from->segment[lanes[k]], (double[]){begin + i * width, begin + (i + 1) * width});
        }
    }
    fill_up(to, at);
}

// The open pairs of those lanes, in the parts of these.
static void carry_over(const cover_list *from, const cover_lanes *lanes, const unsigned of[COVER8], cover_list *to) {
    to->count = 0;
    for (uint32_t i = 0; i < from->count; i++) {
        unsigned open = 0;
        for (unsigned k = 0; k < COVER8; k++)
            if (lanes->used >> k & 1) open |= (from->items[i].lanes >> of[k] & 1u) << k;
        cover_list_add(to, from->items[i].number, open);
    }
}

// ---- what is open

static void leave_pair(path_cover *c, uint32_t number, cover_segment *to) {
    uint32_t parts = (uint32_t)c->w->cell->parts.count, items = (uint32_t)c->w->cell->items.count,
             first = items * parts;
    uint32_t row = c->query.mask_groups * ROBOT8;
    uint32_t at = number < first ? number / parts * row + number % parts : items * row + (number - first);
    to->left[at / ROBOT8] |= (uint8_t)(1u << at % ROBOT8);
    to->is_open = 1;
}

// What is open is so in the end: the search's.
static void leave(path_cover *c, const cover_list *open, const cover_lanes *lanes, unsigned mask) {
    for (uint32_t i = 0; i < open->count; i++)
        for (unsigned rest = open->items[i].lanes & mask; rest; rest &= rest - 1)
            leave_pair(c, open->items[i].number, &c->segments[lanes->segment[compiler_count_low_zeros(rest)]]);
    for (; mask; mask &= mask - 1) {
        unsigned k = compiler_count_low_zeros(mask);
        cover_segment *to = &c->segments[lanes->segment[k]];
        to->begin = min2(to->begin, lanes->begin[k]);
        to->end = max2(to->end, lanes->end[k]);
    }
}

static void look_closer(path_cover *c, uint32_t level, unsigned mask);

// Up to OPEN_MOST lanes at a time; those of segments that were found to hit meanwhile are of no interest.
static void look_at_rest(path_cover *c, uint32_t level) {
    const cover_list *from = &c->lists[level];
    const cover_lanes *lanes = &c->lanes[level];
    unsigned open = 0;
    for (uint32_t i = 0; i < from->count; i++) open |= from->items[i].lanes;
    while (open) {
        unsigned some = 0;
        for (int i = 0; i < OPEN_MOST && open; open &= open - 1) {
            unsigned k = compiler_count_low_zeros(open);
            if (c->segments[lanes->segment[k]].hit_at < INFINITY) continue;
            some |= 1u << k;
            i++;
        }
        if (some) look_closer(c, level, some);
    }
}

// A block of parts of the open lanes of the level before, at most OPEN_MOST of them.
static void look_closer(path_cover *c, uint32_t level, unsigned mask) {
    if (level + 1 == COVER_LEVELS || c->blocks == BLOCKS_MOST + BLOCKS_MORE * (c->segment_count - 1) ||
        watch_is_stopped(c->query.watch)) {
        leave(c, &c->lists[level], &c->lanes[level], mask);
        return;
    }
    cover_lanes *lanes = &c->lanes[level + 1];
    cover_list *to = &c->lists[level + 1];
    unsigned of[COVER8] = {0};
    divide(&c->lanes[level], mask, lanes, of);
    carry_over(&c->lists[level], lanes, of, &c->carried);
    cover_open_block(c, lanes);
    cover_test_open(c, &c->carried, to);
    cover_find_inner_hit(c, to, 0);
    cover_query_middles(c, to);
    cover_test_hulls(c, to);
    look_at_rest(c, level + 1);
}

void path_cover_prove(path_cover *c) {
    divide_segments(c, &c->lanes[0]);
    cover_open_block(c, &c->lanes[0]);
    cover_test_all(c, &c->lists[0]);
    cover_query_middles(c, &c->lists[0]);
    cover_test_hulls(c, &c->lists[0]);
    look_at_rest(c, 0);
}
