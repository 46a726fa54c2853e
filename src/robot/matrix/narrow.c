// Which steps two groups need: all above their items' frames. Steps are in an order in which parents come first, so one
// pass from the last to the first finds them.
#include "robot/matrix/narrow.h"

#include <string.h>

// The next part of a block of memory, aligned; counted alone where there is no block yet.
static void *take(char *block, size_t *at, size_t bytes) {
    void *part = block ? block + *at : NULL;
    *at += (bytes + 63) / 64 * 64;
    return part;
}

static size_t place_all(narrow_work *n, char *block) {
    size_t at = 0, steps = n->whole->step_count, links = n->whole->first[n->whole->cell->items.count];
    n->w.steps = take(block, &at, steps * sizeof *n->w.steps);
    n->w.axes = take(block, &at, steps * sizeof *n->w.axes);
    n->w.speeds = take(block, &at, steps * sizeof *n->w.speeds);
    n->w.links = take(block, &at, links * sizeof *n->w.links);
    n->w.joints = take(block, &at, steps * sizeof *n->w.joints);
    n->place = take(block, &at, steps * sizeof *n->place);
    n->is_needed = take(block, &at, n->whole->cell->frame_count);
    return at;
}

int narrow_create(narrow_work *n, const path_work *whole) {
    *n = (narrow_work){.w = *whole, .whole = whole};
    n->block = allocator_allocate(&whole->allocator, place_all(n, NULL) + 64, 1);
    if (!n->block) return 0;
    place_all(n, n->block);
    memset(whole->frame_errors, 0, whole->cell->frame_count * sizeof *whole->frame_errors);
    return 1;
}

void narrow_destroy(narrow_work *n) {
    if (n->whole) allocator_release(&n->whole->allocator, n->block);
}

static const cell_group *get_group(const narrow_work *n, uint32_t i) { return &cell_groups(n->whole->cell)[i]; }

static void mark_items(const narrow_work *n, const cell_group *g) {
    for (uint32_t i = g->first; i < g->end; i++) n->is_needed[cell_items(n->whole->cell)[i].frame] = 1;
}

static void copy_links(const narrow_work *n, const cell_group *g) {
    for (uint32_t k = n->whole->first[g->first]; k < n->whole->first[g->end]; k++)
        n->w.links[k] = (item_link){n->place[n->whole->links[k].step], 0, 0, 0};
}

void narrow_choose(narrow_work *n, uint32_t group_a, uint32_t group_b) {
    const path_work *whole = n->whole;
    memset(n->is_needed, 0, whole->cell->frame_count);
    mark_items(n, get_group(n, group_a));
    mark_items(n, get_group(n, group_b));
    for (uint32_t i = whole->step_count; i-- > 0;)
        if (n->is_needed[whole->steps[i].child] && whole->steps[i].parent != OVOID_ROBOT_NONE)
            n->is_needed[whole->steps[i].parent] = 1;
    uint32_t count = 0;
    for (uint32_t i = 0; i < whole->step_count; i++) {
        if (!n->is_needed[whole->steps[i].child]) continue;
        n->w.steps[count] = whole->steps[i];
        n->w.joints[count] = whole->joints[i];
        n->w.axes[count] = whole->axes[i];
        n->place[i] = count++;
    }
    n->w.step_count = count;
    copy_links(n, get_group(n, group_a));
    copy_links(n, get_group(n, group_b));
    n->w.level = -1; // errors are of the frames of other groups
}
