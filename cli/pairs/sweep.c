// Sweep and prune along x: D. Baraff, Dynamic simulation of non-penetrating rigid bodies, 1992.
#include "pairs/sweep.h"

#include "base/args.h"
#include "base/message.h"

#include <math.h>
#include <stdlib.h>

/// The extent of a box along x.
typedef struct span {
    double low, high;
    uint32_t box;
} span;

static int compare_spans(const void *a, const void *b) {
    const span *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return p->box < q->box ? -1 : p->box > q->box;
}

/// 1 if two boxes are not proven farther apart than the margin.
static int is_near(const ovoid_box *a, const ovoid_box *b, double margin) {
    const double gaps[] = {b->min.x - a->max.x, a->min.x - b->max.x, b->min.y - a->max.y,
                           a->min.y - b->max.y, b->min.z - a->max.z, a->min.z - b->max.z};
    for (int i = 0; i < 6; i++)
        if (gaps[i] > margin * (1 + 1e-15)) return 0;
    return 1;
}

static span make_span(const ovoid_box *box, uint32_t i, double margin) {
    if (isnan(box->min.x)) return (span){-HUGE_VAL, HUGE_VAL, i};
    double high = box->max.x + margin;
    return (span){box->min.x, high + 1e-15 * fabs(high), i};
}

int sweep_find(const ovoid_box *boxes, size_t count, double margin, sweep_visit visit, void *context) {
    span *spans = malloc((count + 1) * sizeof *spans);
    int code = 0;
    if (!spans) return message_error("out of memory"), EXIT_INPUT;
    for (size_t i = 0; i < count; i++) spans[i] = make_span(&boxes[i], (uint32_t)i, margin);
    qsort(spans, count, sizeof *spans, compare_spans);
    for (size_t i = 0; i < count && !code; i++)
        for (size_t k = i + 1; k < count && !(spans[k].low > spans[i].high) && !code; k++) {
            uint32_t a = spans[i].box, b = spans[k].box;
            if (!is_near(&boxes[a], &boxes[b], margin)) continue;
            code = visit(context, (ovoid_couple){a < b ? a : b, a < b ? b : a});
        }
    free(spans);
    return code;
}
