// Chart 3: how many facets step (g) of Su, Liu, Chen tests, and how long it takes: with full checking, with eight areas
// under the paper's rule and under the sound one, with the one area that contains the ray, and with 6 k k smaller
// areas. Then the paper's closing question: the effect of more and smaller areas.
#include "paper/experiment.h"

#include <math.h>
#include <stdlib.h>

enum { RULES = 4, CUBES = 6, WAYS = RULES + CUBES, REPEATS = 5 };

static const char *const names[WAYS] = {"all facets",       "8 areas by the paper's rule",
                                        "8 areas by signs", "own octant",
                                        "6 areas (k=1)",    "24 (k=2)",
                                        "96 (k=4)",         "384 (k=8)",
                                        "1536 (k=16)",      "6144 (k=32)"};

/// The rays of one body over all frames, and the tables for each way to find their exits.
typedef struct exits {
    const ovoid_areas *areas[WAYS];
    ovoid_areas *own[CUBES];
    ovoid_split_counts split;
    ovoid_sym3 root; ///< of Q^-1: from directions of the body to those of sphere space
    ovoid_vec3 *direction, *toward;
    uint32_t count;
} exits;

static ovoid_area_rule get_rule(int way) {
    static const ovoid_area_rule rules[RULES] = {OVOID_RULE_ALL, OVOID_RULE_PAPER, OVOID_RULE_SIGNS, OVOID_RULE_RAY};
    return way < RULES ? rules[way] : OVOID_RULE_RAY;
}

/// Q^-1/2 by the iteration of Denman and Beavers (1976), for the well-rounded ellipsoids here.
static ovoid_sym3 compute_inverse_root(ovoid_sym3 q) {
    ovoid_sym3 y = q, z = {1, 0, 0, 1, 0, 1};
    for (int i = 0; i < 40; i++) {
        ovoid_sym3 yi = sym3_inverse(y), zi = sym3_inverse(z);
        y = sym3_mean(y, zi);
        z = sym3_mean(z, yi);
    }
    return z;
}

/// Pieces in the octants that a rule keeps for the direction to the other body.
static double count_pieces(const exits *list, ovoid_vec3 toward, ovoid_area_rule rule) {
    const ovoid_sym3 *r = &list->root;
    ovoid_vec3 d = {r->xx * toward.x + r->xy * toward.y + r->xz * toward.z,
                    r->xy * toward.x + r->yy * toward.y + r->yz * toward.z,
                    r->xz * toward.x + r->yz * toward.y + r->zz * toward.z};
    double kept = 0, size = sqrt(3 * vec3_dot(d, d));
    for (int octant = 0; octant < 8; octant++) {
        double a = octant & 1 ? -d.x : d.x, b = octant & 2 ? -d.y : d.y, c = octant & 4 ? -d.z : d.z;
        int dropped = rule == OVOID_RULE_PAPER   ? (a + b + c) / size < -sqrt(0.5)
                      : rule == OVOID_RULE_SIGNS ? a < 0 && b < 0 && c < 0
                                                 : 0;
        if (!dropped) kept += list->split.per_octant[octant];
    }
    return kept;
}

static int exits_make(exits *list, const ovoid_shape *shape, const ovoid_areas *octants, uint32_t capacity) {
    *list = (exits){.direction = calloc(capacity, sizeof *list->direction),
                    .toward = calloc(capacity, sizeof *list->toward)};
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_ellipsoid inner = ovoid_shape_get_inner(shape).ellipsoid;
    list->split = ovoid_polytope_compute_split(&p, &inner);
    list->root = compute_inverse_root(inner.q);
    for (int i = 0; i < WAYS; i++) list->areas[i] = octants;
    int good = list->direction && list->toward;
    for (int i = 0; i < CUBES && good; i++) {
        list->own[i] =
            ovoid_areas_create(&p, &inner, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 1u << i}, NULL);
        list->areas[RULES + i] = list->own[i];
        good = list->own[i] != NULL;
    }
    return good;
}

static void exits_destroy(exits *list) {
    for (int i = 0; i < CUBES; i++) ovoid_areas_destroy(list->own[i]);
    free(list->direction);
    free(list->toward);
}

static void exits_add(exits *list, ovoid_vec3 direction, ovoid_vec3 toward) {
    list->direction[list->count] = direction;
    list->toward[list->count++] = toward;
}

/// The cost of one way to find exits, summed over rays.
typedef struct cost {
    double touched, wrong, ns, rays;
    double pieces; ///< of the faces as the three planes split them, in the octants that the rule keeps
} cost;

static void count_exits(const exits *list, cost sums[WAYS]) {
    for (uint32_t i = 0; i < list->count; i++) {
        double truth = 0;
        for (int way = 0; way < WAYS; way++) {
            ovoid_exit e = ovoid_areas_find_exit(list->areas[way], list->direction[i], list->toward[i], get_rule(way));
            if (way == 0) truth = e.t;
            sums[way].touched += e.touched;
            sums[way].wrong += e.t != truth;
            sums[way].rays++;
            sums[way].pieces += count_pieces(list, list->toward[i], get_rule(way));
        }
    }
}

/// Adds the least time of several repetitions of all rays, alternating between the ways.
static void time_exits(const exits *list, cost sums[WAYS]) {
    double best[WAYS], sum = 0;
    for (int way = 0; way < WAYS; way++) best[way] = INFINITY;
    for (int repeat = 0; repeat < REPEATS; repeat++)
        for (int way = 0; way < WAYS; way++) {
            double start = clock_get_ns();
            for (uint32_t i = 0; i < list->count; i++)
                sum += ovoid_areas_find_exit(list->areas[way], list->direction[i], list->toward[i], get_rule(way)).t;
            best[way] = fmin(best[way], clock_get_ns() - start);
        }
    for (int way = 0; way < WAYS; way++) sums[way].ns += isnan(sum) ? NAN : best[way];
}

/// Measures both bodies of every frame of one model.
static int measure_model(const experiment *e, int object, cost sums[WAYS]) {
    exits box, other;
    int good = exits_make(&box, e->models[0].shape, e->models[0].areas, e->frames);
    good &= exits_make(&other, e->models[object].shape, e->models[object].areas, e->frames);
    for (uint32_t i = 0; i < e->frames && good; i++) {
        ovoid_pair pair = experiment_get_frame(e, object, i);
        exit_rays rays = experiment_find_rays(&pair);
        if (rays.overlap) continue;
        exits_add(&box, rays.direction[0], rays.toward[0]);
        exits_add(&other, rays.direction[1], rays.toward[1]);
    }
    if (good) {
        count_exits(&box, sums);
        count_exits(&other, sums);
        time_exits(&box, sums);
        time_exits(&other, sums);
    }
    exits_destroy(&box);
    exits_destroy(&other);
    return good;
}

/// Measures one model against every other one, at the poses of experiment_get_mutual.
static int measure_mutual(const experiment *e, int model, cost sums[WAYS]) {
    uint32_t places = (e->frames + 15) / 16;
    exits list;
    int good = exits_make(&list, e->models[model].shape, e->models[model].areas, MODEL_COUNT * places);
    for (int other = 0; other < MODEL_COUNT && good; other++)
        for (uint32_t k = 0; k < places && other != model; k++) {
            int first = model < other;
            ovoid_pair pair = experiment_get_mutual(e, first ? model : other, first ? other : model, k);
            exit_rays rays = experiment_find_rays(&pair);
            if (!rays.overlap) exits_add(&list, rays.direction[!first], rays.toward[!first]);
        }
    if (good) {
        count_exits(&list, sums);
        time_exits(&list, sums);
    }
    exits_destroy(&list);
    return good;
}

static void add_costs(cost sum[WAYS], const cost one[WAYS]) {
    for (int way = 0; way < WAYS; way++) {
        sum[way].touched += one[way].touched;
        sum[way].wrong += one[way].wrong;
        sum[way].ns += one[way].ns;
        sum[way].rays += one[way].rays;
        sum[way].pieces += one[way].pieces;
    }
}

/// Rows of the table after the families: the box past all others, and each model against each.
enum { ALL = FAMILY_COUNT, MUTUAL, GROUPS };

static void add_table(const experiment *e, cost sums[GROUPS][WAYS]) {
    report_table *t = report_begin_table(e->report, "faces",
                                         "models,way,rays,facets looked at,facets saved %,pieces saved %,exits wrong");
    report_table *times = report_begin_table(e->report, "faces_time", "models,way,ns a ray,time saved %");
    for (int family = 1; family < GROUPS; family++) {
        const char *name = family == ALL      ? "all"
                           : family == MUTUAL ? "each against each"
                                              : paper_family_get_name((paper_family)family);
        const cost *all = &sums[family][0];
        for (int way = 0; way < WAYS; way++) {
            const cost *c = &sums[family][way];
            char pieces[24] = "";
            if (way < 3) snprintf(pieces, sizeof pieces, "%.2f", 100 * (1 - c->pieces / all->pieces));
            report_add_row(t, "%s,%s,%.0f,%.2f,%.2f,%s,%.0f", name, names[way], c->rays, c->touched / c->rays,
                           100 * (1 - c->touched / all->touched), pieces, c->wrong);
            report_add_row(times, "%s,%s,%.1f,%.1f", name, names[way], c->ns / c->rays, 100 * (1 - c->ns / all->ns));
        }
    }
    report_end_table(t, 0);
    report_end_table(times, 0);
}

/// The time of the step for each model: chart 3 as in the paper, and its table.
static void add_models(const experiment *e, cost models[MODEL_COUNT][WAYS]) {
    static const int shown[] = {0, 1, 2, 3, 8};
    enum { SHOWN = sizeof shown / sizeof *shown };
    double x[MODEL_COUNT], ns[SHOWN][MODEL_COUNT];
    ovoid_series series[SHOWN];
    report_table *t = report_begin_table(
        e->report, "faces_models", "model,rays,all facets ns,paper's rule ns,signs ns,own octant ns,1536 areas ns");
    for (int i = 1; i < MODEL_COUNT; i++) {
        x[i] = i;
        for (int k = 0; k < SHOWN; k++) ns[k][i] = models[i][shown[k]].ns / models[i][shown[k]].rays;
        report_add_row(t, "%s,%.0f,%.1f,%.1f,%.1f,%.1f,%.1f", e->models[i].name, models[i][0].rays, ns[0][i], ns[1][i],
                       ns[2][i], ns[3][i], ns[4][i]);
    }
    for (int k = 0; k < SHOWN; k++)
        series[k] = (ovoid_series){names[shown[k]], OVOID_SERIES_LINE, MODEL_COUNT - 1, x + 1, ns[k] + 1, NULL, NULL};
    report_add_chart(e->report, "chart3_models",
                     &(ovoid_chart){.title = "Chart 3: time of the step, model by model",
                                    .x_label = "model: 1 to 10 cylinders, 11 to 20 complex, 21 to 30 spheres",
                                    .y_label = "ns a ray",
                                    .y_min = 0,
                                    .series = series,
                                    .series_count = SHOWN});
    report_end_table(t, 0);
}

static void add_saved_chart(const experiment *e, cost sums[GROUPS][WAYS]) {
    static const char *const families[] = {"cylinders", "complex cylinders", "spheres", "all", "each against each"};
    enum { SHOWN = GROUPS - 1 };
    double saved[WAYS][SHOWN], time[WAYS][SHOWN];
    ovoid_series series[WAYS], seconds[WAYS];
    const int shown[] = {1, 2, 3, 6, 8};
    for (int i = 0; i < 5; i++) {
        for (int family = 0; family < SHOWN; family++) {
            const cost *all = &sums[family + 1][0], *c = &sums[family + 1][shown[i]];
            saved[i][family] = 100 * (1 - c->touched / all->touched);
            time[i][family] = 100 * (1 - c->ns / all->ns);
        }
        series[i] = (ovoid_series){names[shown[i]], OVOID_SERIES_BARS, SHOWN, NULL, saved[i], NULL, NULL};
        seconds[i] = (ovoid_series){names[shown[i]], OVOID_SERIES_BARS, SHOWN, NULL, time[i], NULL, NULL};
    }
    ovoid_chart chart = {.title = "Chart 3: facets not looked at",
                         .y_label = "percent saved",
                         .series = series,
                         .series_count = 5,
                         .categories = families,
                         .category_count = SHOWN};
    report_add_chart(e->report, "chart3_faces", &chart);
    chart.title = "Chart 3: time of the step saved";
    chart.series = seconds;
    report_add_chart(e->report, "chart3_time", &chart);
}

static void add_verdicts(const experiment *e, const cost *all) {
    char saved[120], time[120], own[160];
    double pieces = 100 * (1 - all[1].pieces / all[0].pieces), slower = all[1].ns / all[0].ns;
    snprintf(saved, sizeof saved, "%.1f %% in pieces, as it counts; %.1f %% in facets", pieces,
             100 * (1 - all[1].touched / all[0].touched));
    snprintf(
        own, sizeof own,
        "looks into the one area that holds the ray: saves %.0f %% of the facets with eight areas, %.0f %% with 1536",
        100 * (1 - all[3].touched / all[0].touched), 100 * (1 - all[8].touched / all[0].touched));
    report_add_verdict(e->report, (report_verdict){"Facial areas save 26.23 % of the faces.",
                                                   pieces > 25 ? REPORT_HOLDS : REPORT_DOES_NOT_HOLD, saved, own});
    snprintf(time, sizeof time, "the step takes %.2f times the time of checking all facets", slower);
    snprintf(own, sizeof own, "%.2f times with the ray's octant, %.2f times with 1536 areas", all[3].ns / all[0].ns,
             all[8].ns / all[0].ns);
    report_add_verdict(e->report, (report_verdict){"They save 14.29 % of the step's time, 14.9 % online.",
                                                   slower < 0.9 ? REPORT_HOLDS : REPORT_DOES_NOT_HOLD, time, own});
}

static void add_finding(const experiment *e, const cost *all) {
    char measured[640];
    snprintf(
        measured, sizeof measured,
        "Counted in pieces, as the paper does, its rule saves %.1f %% and the rule of signs %.1f %%. "
        "In facets it looks at %.1f %% fewer, and takes %.2f times the time of checking all; it is wrong in %.0f of "
        "%.0f exits. The rule of signs saves %.1f %% of the facets, the one octant that holds the ray %.1f %%, 1536 "
        "small areas %.1f %%.",
        100 * (1 - all[1].pieces / all[0].pieces), 100 * (1 - all[2].pieces / all[0].pieces),
        100 * (1 - all[1].touched / all[0].touched), all[1].ns / all[0].ns, all[1].wrong, all[0].rays,
        100 * (1 - all[2].touched / all[0].touched), 100 * (1 - all[3].touched / all[0].touched),
        100 * (1 - all[8].touched / all[0].touched));
    report_add_finding(
        e->report,
        (report_finding){
            "26.23 % fewer faces, 14.29 % less time in the step, 14.9 % less over the online steps "
            "(0.788 s to 0.701 s, which is 11.0 %).",
            measured,
            "A facet that reaches into several areas is in the list of each, and large facets (caps, the "
            "box) are in most: dropping one octant drops few of them. The paper counts the pieces that its "
            "planes cut, so that each lies in one area. Its rule can drop at most two of eight areas, which is 25 % of "
            "evenly spread pieces, and 1.17 on average, 15 %: 26 % takes pieces that are denser behind. Checking "
            "all runs over contiguous memory, several facets at a time, which a list of indices cannot. "
            "Once the ray is known nothing is left to guess: the "
            "area that holds it is enough."});
}

// ---- more and smaller areas

enum { BODIES = 5 };

/// The hull of random points on a sphere: about 2 n facets.
static ovoid_shape *create_ball(uint32_t vertices, uint64_t *state) {
    double *xyz = calloc(vertices, 3 * sizeof *xyz);
    for (uint32_t i = 0; i < vertices && xyz; i++) {
        ovoid_vec3 v = random_direction(state);
        xyz[3 * i] = v.x, xyz[3 * i + 1] = v.y, xyz[3 * i + 2] = v.z;
    }
    ovoid_shape *shape = xyz ? ovoid_shape_create_from_points(xyz, vertices, NULL, NULL) : NULL;
    free(xyz);
    return shape;
}

static int measure_ball(const experiment *e, uint32_t vertices, cost sums[WAYS]) {
    enum { RAYS = 400 };
    uint64_t state = e->seed + vertices;
    ovoid_shape *shape = create_ball(vertices, &state);
    if (!shape) return 0;
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_ellipsoid inner = ovoid_shape_get_inner(shape).ellipsoid;
    ovoid_areas *octants = ovoid_areas_create(&p, &inner, NULL, NULL);
    exits list;
    int good = octants && exits_make(&list, shape, octants, RAYS);
    for (int i = 0; i < RAYS && good; i++) {
        ovoid_vec3 u = random_direction(&state);
        exits_add(&list, u, u);
    }
    if (good) {
        count_exits(&list, sums);
        time_exits(&list, sums);
    }
    if (octants) exits_destroy(&list);
    ovoid_areas_destroy(octants);
    ovoid_shape_destroy(shape);
    return good;
}

static void add_scaling(const experiment *e) {
    static const uint32_t vertices[BODIES] = {22, 102, 502, 2002, 10002};
    static cost sums[BODIES][WAYS];
    double x[CUBES + 1], y[BODIES][CUBES + 1], ns[BODIES][CUBES + 1];
    char labels[BODIES][24];
    ovoid_series touched[BODIES], times[BODIES];
    report_table *t = report_begin_table(e->report, "areas", "facets,areas,facets looked at,ns a ray");
    for (int i = 0; i < BODIES; i++) {
        if (!measure_ball(e, vertices[i], sums[i])) break;
        uint32_t facets = 2 * vertices[i] - 4;
        snprintf(labels[i], sizeof labels[i], "%u facets", facets);
        for (int k = 0; k <= CUBES; k++) {
            const cost *c = &sums[i][k ? RULES + k - 1 : 0];
            x[k] = k ? 6 << (2 * (k - 1)) : 1;
            y[i][k] = c->touched / c->rays;
            ns[i][k] = c->ns / c->rays;
            report_add_row(t, "%u,%.0f,%.2f,%.1f", facets, x[k], y[i][k], ns[i][k]);
        }
        touched[i] = (ovoid_series){labels[i], OVOID_SERIES_LINE, CUBES + 1, x, y[i], NULL, NULL};
        times[i] = (ovoid_series){labels[i], OVOID_SERIES_LINE, CUBES + 1, x, ns[i], NULL, NULL};
    }
    report_end_table(t, 0);
    report_add_section(e->report, "More and smaller areas");
    ovoid_chart chart = {.title = "Facets that an exit looks at",
                         .x_label = "number of areas",
                         .y_label = "facets",
                         .series = touched,
                         .series_count = BODIES,
                         .x_log = 1,
                         .y_log = 1};
    report_add_chart(e->report, "areas_facets", &chart);
    chart.title = "Time of an exit";
    chart.y_label = "ns";
    chart.series = times;
    report_add_chart(e->report, "areas_time", &chart);
    char measured[400];
    const cost *last = &sums[BODIES - 1][WAYS - 1], *full = &sums[BODIES - 1][0];
    snprintf(measured, sizeof measured,
             "With as many areas as facets an exit looks at a few facets, whatever the body: %.1f of 20 000 with 6144 "
             "areas, in %.0f ns against %.0f ns.",
             last->touched / last->rays, last->ns / last->rays, full->ns / full->rays);
    report_add_verdict(e->report, (report_verdict){"More and smaller areas save more.",
                                                   last->touched < full->touched ? REPORT_HOLDS : REPORT_DOES_NOT_HOLD,
                                                   measured, "tables of 6 k k areas, of any k"});
    report_add_finding(e->report,
                       (report_finding){"Its conclusion: more and smaller areas should save more.", measured,
                                        "Facets looked at fall as one over the number of areas until an area "
                                        "is as small as a facet; from there on the cost is constant, and the "
                                        "table only grows."});
}

void experiment_add_faces(const experiment *e) {
    static cost sums[GROUPS][WAYS], models[MODEL_COUNT][WAYS];
    report_add_section(e->report, "Chart 3: facial areas against full checking");
    report_add_text(e->report,
                    "The box moves past the other models, as in the paper; \"each against each\" are all pairs of "
                    "models at random places, from deep overlap to two sizes apart.");
    for (int i = 0; i < MODEL_COUNT; i++) {
        cost frames[WAYS] = {{0}}, mutual[WAYS] = {{0}};
        if ((i > 0 && !measure_model(e, i, frames)) || !measure_mutual(e, i, mutual)) break;
        add_costs(models[i], frames);
        add_costs(sums[e->models[i].family], frames);
        add_costs(sums[ALL], frames);
        add_costs(sums[MUTUAL], mutual);
    }
    add_table(e, sums);
    add_saved_chart(e, sums);
    add_models(e, models);
    add_verdicts(e, sums[ALL]);
    add_finding(e, sums[ALL]);
    add_scaling(e);
}
