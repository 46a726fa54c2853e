// A scene at rest, cut: the objects are put into small cells, and these into CELLS cells for each part, which are dealt
// out in turn, so that neighbours go to different parts. The weight of a small cell is the number of pairs that its
// objects are expected to have by how dense they are.
//
// What a part searches has all objects that a world would pair with its own: each object is in a cube around its
// enclosing ball with half the margin and 8 % of the radius. A world leaves 4 % of a reach that is at most twice the
// radius (world_compute_box), so its boxes are in these cubes; and a pair whose cubes do not overlap is farther apart
// than the margin by 8 % of both radii, which a world would prove. A pair belongs to its smaller object, so a floor
// that touches all does not bring all to one part: of own objects only those that are no larger count.
//
// Cost: linear in the objects, times the logarithm of the cells.
#include "pairs/cut.h"

#include "base/args.h"
#include "base/message.h"
#include "pairs/balls.h"
#include "pairs/cells.h"

#include <math.h>
#include <stdlib.h>

/// Cells for each part, and objects of a small cell where there are enough.
#define CELLS 4
#define SMALL 32

/// How much larger than its enclosing ball the cube of an object is.
#define ROOM 0.08
/// Covers the rounding of radii, and relative to the place that of centres.
#define SLACK 1e-9
#define SLACK_PLACE 1e-12

/// What an object costs without any pair, in pairs.
#define ALONE 0.1

typedef struct bounds {
    double low[3], high[3];
} bounds;

/// A small cell: its points, side by side.
typedef struct small_cell {
    size_t first, end;
    bounds around; ///< their cubes
} small_cell;

/// The state of a cut. The arrays have an item for each object at least.
typedef struct cutter {
    cli_cut *cut;
    size_t count;
    cell_point *points, *small_points;
    bounds *cubes;     ///< by object
    bounds *cumulated; ///< by point: the cubes of those of its small cell that are no larger
    small_cell *small_cells;
    size_t small_count;
} cutter;

static const bounds nothing = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

static void join(bounds *b, const bounds *more) {
    for (int k = 0; k < 3; k++) {
        b->low[k] = more->low[k] < b->low[k] ? more->low[k] : b->low[k];
        b->high[k] = more->high[k] > b->high[k] ? more->high[k] : b->high[k];
    }
}

static int is_overlapping(const bounds *a, const bounds *b) {
    for (int k = 0; k < 3; k++)
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return 0;
    return 1;
}

static double sum_abs(ovoid_vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

static void set_object(cutter *c, cli_balls *b, const near_scene *of, size_t i) {
    const ovoid_pose *pose = &of->poses[i];
    const ovoid_body body = ovoid_scene_get_body(of->scene, i, pose);
    const cli_ball *local = balls_find(b, &body);
    ovoid_vec3 at = ovoid_pose_compute_point(pose, local->center);
    double half = (local->radius * (1 + ROOM) + of->margin / 2) * (1 + SLACK) +
                  SLACK_PLACE * (sum_abs(at) + sum_abs(local->center) + local->radius);
    c->cut->radii[i] = local->radius;
    c->points[i] = (cell_point){{at.x, at.y, at.z}, 1, (uint32_t)i, 0};
    c->cubes[i] = (bounds){{at.x - half, at.y - half, at.z - half}, {at.x + half, at.y + half, at.z + half}};
}

/* ---- small cells */

/// The pairs that points of a small cell are expected to have: each with those whose centres are in a cube as large as
/// two of theirs, where they are as dense as in the cell's box. The box is no thinner than a cube along any axis.
static double estimate_pairs(const cutter *c, const small_cell *s) {
    double sum = 0, share = 1, count = (double)(s->end - s->first);
    for (size_t i = s->first; i < s->end; i++) {
        const bounds *cube = &c->cubes[c->points[i].id];
        sum += cube->high[0] - cube->low[0];
    }
    double edge = sum / count;
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t i = s->first; i < s->end; i++) {
            low = fmin(low, c->points[i].at[k]);
            high = fmax(high, c->points[i].at[k]);
        }
        share *= fmin(1, 2 * edge / fmax(high - low, edge));
    }
    return count * (ALONE + count * (share > 0 ? share : 1));
}

/// Sorts the points of a small cell by their radii; there are few, and mostly they are sorted.
static void sort_points(const cutter *c, const small_cell *s) {
    for (size_t i = s->first + 1; i < s->end; i++) {
        cell_point kept = c->points[i];
        size_t at = i;
        for (; at > s->first && c->cut->radii[c->points[at - 1].id] > c->cut->radii[kept.id]; at--)
            c->points[at] = c->points[at - 1];
        c->points[at] = kept;
    }
}

static void make_small_cells(cutter *c, size_t size) {
    cells_make(c->points, c->count, (uint32_t)((c->count + size - 1) / size));
    for (size_t first = 0, end; first < c->count; first = end) {
        small_cell *s = &c->small_cells[c->small_count];
        bounds centers = nothing;
        for (end = first; end < c->count && c->points[end].cell == c->points[first].cell; end++) {
            const double *at = c->points[end].at;
            join(&centers, &(bounds){{at[0], at[1], at[2]}, {at[0], at[1], at[2]}});
        }
        *s = (small_cell){first, end, nothing};
        cell_point *p = &c->small_points[c->small_count];
        *p = (cell_point){.weight = estimate_pairs(c, s), .id = (uint32_t)c->small_count++};
        for (int k = 0; k < 3; k++) p->at[k] = centers.low[k] / 2 + centers.high[k] / 2;
    }
}

/* ---- roles */

/// The part owns the points of a small cell.
static void own(cutter *c, small_cell *s) {
    sort_points(c, s);
    for (size_t i = s->first; i < s->end; i++) {
        uint32_t object = c->points[i].id;
        c->cut->roles[object] = CUT_OWN;
        join(&s->around, &c->cubes[object]);
        c->cumulated[i] = s->around;
    }
}

/// 1 if an object may be near one of an own small cell that is no larger.
static int is_near(const cutter *c, const small_cell *s, size_t object) {
    const bounds *cube = &c->cubes[object];
    if (!is_overlapping(&s->around, cube)) return 0;
    size_t end = s->end;
    while (end > s->first && c->cut->radii[c->points[end - 1].id] > c->cut->radii[object]) end--;
    return end > s->first && is_overlapping(&c->cumulated[end - 1], cube);
}

/// Marks the objects that may be near those of own small cells, `first` to end - 1 of the small points.
static void mark_near(cutter *c, size_t first, size_t end) {
    bounds all = nothing;
    for (size_t k = first; k < end; k++) join(&all, &c->small_cells[c->small_points[k].id].around);
    for (size_t i = 0; i < c->count; i++) {
        unsigned char *role = &c->cut->roles[i];
        if (*role != CUT_FAR || !is_overlapping(&all, &c->cubes[i])) continue;
        for (size_t k = first; k < end && *role == CUT_FAR; k++)
            if (is_near(c, &c->small_cells[c->small_points[k].id], i)) *role = CUT_NEAR;
    }
}

static void cut_objects(cutter *c, shard_part part) {
    size_t cells = (size_t)CELLS * part.count, size = c->count / (4 * cells);
    make_small_cells(c, size < 1 ? 1 : size < SMALL ? size : SMALL);
    cells_make(c->small_points, c->small_count, (uint32_t)cells);
    for (size_t k = 0; k < c->small_count; k++)
        if (shard_part_has(part, c->small_points[k].cell)) own(c, &c->small_cells[c->small_points[k].id]);
    for (size_t first = 0, end; first < c->small_count; first = end) {
        for (end = first + 1; end < c->small_count && c->small_points[end].cell == c->small_points[first].cell;) end++;
        if (shard_part_has(part, c->small_points[first].cell)) mark_near(c, first, end);
    }
}

/* ---- the cut */

int cut_open(cli_cut *cut, const near_scene *of, shard_part part) {
    size_t count = ovoid_scene_get_count(of->scene);
    *cut = (cli_cut){.roles = NULL};
    if (part.count < 2) return 0;
    cli_balls b = balls_create(count);
    cutter c = {.cut = cut, .count = count};
    c.points = calloc(count + 1, sizeof *c.points);
    c.small_points = calloc(count + 1, sizeof *c.small_points);
    c.cubes = calloc(count + 1, sizeof *c.cubes);
    c.cumulated = calloc(count + 1, sizeof *c.cumulated);
    c.small_cells = calloc(count + 1, sizeof *c.small_cells);
    cut->roles = calloc(count + 1, 1);
    cut->radii = calloc(count + 1, sizeof *cut->radii);
    int done =
        b.slots && c.points && c.small_points && c.cubes && c.cumulated && c.small_cells && cut->roles && cut->radii;
    for (size_t i = 0; i < count && done; i++) set_object(&c, &b, of, i);
    if (done) cut_objects(&c, part);
    balls_destroy(&b);
    free(c.points);
    free(c.small_points);
    free(c.cubes);
    free(c.cumulated);
    free(c.small_cells);
    if (done) return 0;
    cut_close(cut);
    message_error("out of memory");
    return EXIT_INPUT;
}

void cut_close(cli_cut *cut) {
    free(cut->roles);
    free(cut->radii);
    *cut = (cli_cut){.roles = NULL};
}
