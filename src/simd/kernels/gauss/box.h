// The plane of a box and another body, the hull, by the box's three axes e_k and half lengths h_k; all here is in the
// hull's body frame. Along a direction m that looks out of the hull the height of the difference is
//
//     h(m) = support of the hull + sum h_k |e_k.m| - center.m
//
// so that a normal m_f of the hull needs no vertex of the box: four numbers d_k = e_k.m_f and s = low - center.m_f say
// its height. The box's own normals +-e_k need how far the hull's vertices reach along the axes. The arcs of the box
// are quarters of the three great circles across its axes. So an arc of the hull crosses an arc of the box where d_k of
// its ends differ in sign; the crossing m = |d_k(g)| m_f + |d_k(f)| m_g has numbers d and s that are sums of those of
// its ends. A corner of the box shows of an arc that no crossing of it is the lowest, as in gauss.h: its value along
// m_f is s + sum +-h_k d_k.
//
// What is clear. Heights here are off by less than 512 u s over a crossing's length, s the pair's size, hence by less
// than 2^-26 s where no d_k is nearer to 0 than 2^-16 and no crossing is shorter than 2^-18; and by how far the hull's
// vertices are above its planes, which is less than 2^-27 s. A plane that is lower than
// all others by 2^-24 s is the lowest whatever rounding did, and the one that gauss.h finds. Its height is measured as
// it is there, so that the answer has the same bits. All else, as faces that are parallel or heights that are equal, is
// left to gauss.h.
#include "simd/kernels/extents.h"
#include "simd/kernels/gauss/gauss.h"

#define GAUSS_BOX_CLEAR 0x1p-16
#define GAUSS_BOX_SHORT 0x1p-18
#define GAUSS_BOX_APART 0x1p-24

typedef enum gauss_found { GAUSS_NONE, GAUSS_FOUND, GAUSS_OPEN } gauss_found;

// The heights of the planes; those behind the hull's last facet, and of arcs that do not cross, are infinite.
typedef struct gauss_box_search {
    const gauss_query *q;
    const gauss_side *hull;
    uint32_t facets; ///< padded
    double least;    ///< of all heights
    double apart;    ///< heights that differ by more than this are clearly different
    double face[6];  ///< along axis k, and against it (3 + k)
    _Alignas(64) double d[3][GAUSS_FACETS], s[GAUSS_FACETS], height[GAUSS_FACETS];
} gauss_box_search;

// The numbers of the hull's normals, and their heights. 0 if a normal is nearly across an axis.
LANES_INLINE int gauss_box_measure_facets(gauss_box_search *search) {
    const gauss_box *by = &search->q->box;
    const lane3 axes[3] = {gauss_spread(by->axes.r0), gauss_spread(by->axes.r1), gauss_spread(by->axes.r2)};
    const lane3 center = gauss_spread(by->center);
    lane least = lane_set(INFINITY), across = lane_set(INFINITY);
    for (uint32_t i = 0; i < search->facets; i += LANES) {
        const double *given = gauss_get_facet(search->hull->map, i);
        lane3 n = gauss_load(given, given + 8, given + 16, 0);
        lane low = lane_load(given + 24), s = low - lane3_dot(n, center), height = s, nearest = lane_set(INFINITY);
        for (int k = 0; k < 3; k++) {
            lane d = lane3_dot(axes[k], n);
            lane_store(search->d[k] + i, d);
            nearest = lane_min(lane_abs(d), nearest);
            height = height + lane_set(by->half[k]) * lane_abs(d);
        }
        lane_store(search->s + i, s);
        lane_store(search->height + i, height);
        least = lane_min(height, least);
        across = lane_min(lane_select(lane_less(low, lane_set(INFINITY)), nearest, lane_set(1)), across);
    }
    search->least = -lane_first(lane_find_max(-least));
    return -lane_first(lane_find_max(-across)) > GAUSS_BOX_CLEAR;
}

// The heights along the axes.
LANES_INLINE void gauss_box_measure_faces(gauss_box_search *search) {
    const gauss_box *by = &search->q->box;
    const simd_extents reach = run_extents(&search->hull->points, &by->axes);
    const vec3 center = mat3_mul_vec3(by->axes, by->center);
    const double middle[3] = {center.x, center.y, center.z};
    for (int k = 0; k < 3; k++) {
        search->face[k] = reach.high[k] - middle[k] + by->half[k];
        search->face[3 + k] = middle[k] - reach.low[k] + by->half[k];
    }
    for (int i = 0; i < 6; i++) search->least = search->face[i] < search->least ? search->face[i] : search->least;
}

// For each facet the box's corners, as bits, whose value along its normal is clearly above the least height.
LANES_INLINE void gauss_box_find_corners(const gauss_box_search *search, uint8_t found[GAUSS_FACETS]) {
    static const double sign[3][8] = {
        {-1, 1, -1, 1, -1, 1, -1, 1}, {-1, -1, 1, 1, -1, -1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1}};
    const double *half = search->q->box.half;
    lane corner[3][8 / LANES];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 8 / LANES; i++) corner[k][i] = lane_set(half[k]) * lane_load(sign[k] + LANES * i);
    const double beyond = search->least + search->apart;
    for (uint32_t f = 0; f < search->hull->map->facets; f++) {
        lane x = lane_set(search->d[0][f]), y = lane_set(search->d[1][f]), z = lane_set(search->d[2][f]);
        lane above = lane_set(beyond - search->s[f]);
        unsigned bits = 0;
        for (int i = 0; i < 8 / LANES; i++) {
            lane value = (corner[0][i] * x + corner[1][i] * y) + corner[2][i] * z;
            bits |= lane_bits(lane_greater(value, above)) << LANES * i;
        }
        found[f] = (uint8_t)bits;
    }
}

// The hull's open arcs as columns: the numbers d and s of both ends, and the heights of the crossings with each circle.
typedef struct gauss_box_arcs {
    gauss_list list;
    _Alignas(64) double from[4][GAUSS_ROOM], to[4][GAUSS_ROOM], height[3][GAUSS_ROOM];
} gauss_box_arcs;

LANES_INLINE void gauss_box_list_arcs(const gauss_box_search *search, gauss_box_arcs *to) {
    _Alignas(64) uint8_t seen[GAUSS_FACETS];
    const gauss_map *map = search->hull->map;
    const double *numbers[4] = {search->d[0], search->d[1], search->d[2], search->s};
    gauss_box_find_corners(search, seen);
    gauss_list_arcs(map, seen, &to->list);
    for (uint32_t i = 0; i < to->list.count; i++)
        for (int k = 0; k < 4; k++) {
            to->from[k][i] = numbers[k][gauss_get_list(map, 0)[to->list.arc[i]]];
            to->to[k][i] = numbers[k][gauss_get_list(map, 1)[to->list.arc[i]]];
        }
    for (int k = 0; k < 4; k++) {
        lane_store(to->from[k] + to->list.count, lane_set(0));
        lane_store(to->to[k] + to->list.count, lane_set(0));
    }
}

// The crossings of LANES arcs with the circle across an axis: heights, which are infinite where arcs do not cross it or
// where the height, by its square, is clearly not the least.
typedef struct gauss_box_circle {
    uint32_t k, i, j; ///< the axis, and the other two
    lane half_i, half_j, beyond;
} gauss_box_circle;

// Lanes that cross the circle too near to both of their ends are added to *unclear.
LANES_INLINE lane gauss_box_cross(const gauss_box_circle *of, const gauss_box_arcs *arcs, uint32_t at,
                                  lane_mask *unclear) {
    lane a = lane_load(arcs->from[of->k] + at), b = lane_load(arcs->to[of->k] + at);
    lane_mask crosses = lane_less(a * b, lane_set(0));
    lane of_from = lane_abs(b), of_to = lane_abs(a);
    lane x = of_from * lane_load(arcs->from[of->i] + at) + of_to * lane_load(arcs->to[of->i] + at);
    lane y = of_from * lane_load(arcs->from[of->j] + at) + of_to * lane_load(arcs->to[of->j] + at);
    lane s = of_from * lane_load(arcs->from[3] + at) + of_to * lane_load(arcs->to[3] + at);
    lane value = s + (of->half_i * lane_abs(x) + of->half_j * lane_abs(y)), square = x * x + y * y;
    lane_mask is_long = lane_greater(square, lane_set(GAUSS_BOX_SHORT * GAUSS_BOX_SHORT));
    *unclear = lane_or(*unclear, lane_and(crosses, lane_not(is_long)));
    lane top = lane_top(value, lane_set(0));
    crosses = lane_and(crosses, lane_not(lane_greater(top * top, of->beyond * of->beyond * square)));
    if (!lane_bits(crosses)) return lane_set(INFINITY);
    return lane_select(crosses, value / lane_sqrt(square), lane_set(INFINITY));
}

// 0 if a crossing is not clear.
LANES_INLINE int gauss_box_measure_crossings(gauss_box_search *search, gauss_box_arcs *arcs) {
    const double *half = search->q->box.half;
    lane_mask unclear = lane_none();
    lane least = lane_set(search->least), beyond = lane_set(search->least + search->apart);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
        const gauss_box_circle circle = {k, i, j, lane_set(half[i]), lane_set(half[j]), beyond};
        for (uint32_t at = 0; at < arcs->list.count; at += LANES) {
            lane height = gauss_box_cross(&circle, arcs, at, &unclear);
            lane_store(arcs->height[k] + at, height);
            least = lane_min(height, least);
        }
    }
    search->least = -lane_first(lane_find_max(-least));
    return !lane_bits(unclear);
}

// ---- the lowest plane, measured as all bodies' planes are

// The first `count` numbers, of which there are whole lanes, that are not above a height: adds how many they are, and
// sets *place to the last of them.
LANES_INLINE uint32_t gauss_box_count(const double *heights, uint32_t count, double most, uint32_t *place) {
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i += LANES) {
        unsigned low = lane_bits(lane_at_least(lane_set(most), lane_load(heights + i)));
        if (!low) continue;
        found += (uint32_t)__builtin_popcount(low);
        *place = i + (uint32_t)__builtin_ctz(low);
    }
    return found;
}

// A normal of a body in the frame, looking out of the difference, and a point of the difference's summand: of A
// mirrored, of B posed, with the operations of gauss_mirror and gauss_pose.
LANES_INLINE vec3 gauss_box_turn(const gauss_query *q, int is_a, vec3 n) {
    return is_a ? vec3_neg(n) : mat3_mul_vec3(q->rotation, n);
}
LANES_INLINE vec3 gauss_box_place(const gauss_query *q, int is_a, uint32_t i) {
    const simd_points *p = is_a ? &q->a.points : &q->b.points;
    const vec3 x = {p->x[i], p->y[i], p->z[i]};
    return is_a ? vec3_neg(x) : vec3_add(mat3_mul_vec3(q->rotation, x), q->translation);
}

// The facet of the box toward the hull along axis k, of a direction out of the hull that has this part along it.
LANES_INLINE uint32_t gauss_box_get_facet(const gauss_query *q, uint32_t k, double part) {
    const int is_a = q->box.side == 1;
    const gauss_map *map = is_a ? q->a.map : q->b.map;
    const vec3 axis = k == 0 ? q->box.axes.r0 : k == 1 ? q->box.axes.r1 : q->box.axes.r2;
    const vec3 out = part > 0 ? vec3_neg(axis) : axis;
    const lane3 n = gauss_spread(is_a ? mat3_mul_vec3(q->rotation, out) : mat3_mul_transposed_vec3(q->rotation, out));
    unsigned found = 0;
    for (uint32_t i = 0; i < 8; i += LANES) {
        const double *x = gauss_get_facet(map, i);
        found |= lane_bits(lane_greater(lane3_dot(gauss_load(x, x + 8, x + 16, 0), n), lane_set(0.5))) << i;
    }
    return found ? (uint32_t)__builtin_ctz(found) : 0;
}

// How far the points of a body reach along a direction, as gauss_measure_facet has it.
LANES_INLINE double gauss_box_reach(const gauss_query *q, int is_a, lane3 n) {
    const simd_points *p = is_a ? &q->a.points : &q->b.points;
    const lane3 rows[3] = {gauss_spread(q->rotation.r0), gauss_spread(q->rotation.r1), gauss_spread(q->rotation.r2)};
    const lane3 t = gauss_spread(q->translation);
    lane most = lane_set(-INFINITY);
    for (uint32_t i = 0; i < p->padded_count; i += LANES) {
        lane3 v = gauss_load(p->x, p->y, p->z, i);
        v = is_a ? lane3_neg(v) : lane3_add(gauss_turn(rows, v), t);
        most = lane_top(lane3_dot(v, n), most);
    }
    return lane_first(lane_find_max(most));
}

// A plane of a facet of A or of B.
LANES_INLINE void gauss_box_take_facet(const gauss_query *q, gauss_kind kind, uint32_t facet, gauss_plane *out) {
    const int is_a = kind == GAUSS_FACET_A;
    const gauss_map *map = is_a ? q->a.map : q->b.map;
    const vec3 n = gauss_box_turn(q, is_a, gauss_map_get_normal(map, facet));
    double low = gauss_map_get_low(map, facet);
    if (!is_a) low += vec3_dot(n, q->translation);
    *out = (gauss_plane){gauss_box_reach(q, !is_a, gauss_spread(n)) + low, n, kind, facet, facet};
}

// An arc of A or B in the frame.
LANES_INLINE gauss_arc gauss_box_get_arc(const gauss_query *q, int is_a, uint32_t arc) {
    const gauss_map *map = is_a ? q->a.map : q->b.map;
    return (gauss_arc){gauss_box_turn(q, is_a, gauss_map_get_normal(map, gauss_get_list(map, 0)[arc])),
                       gauss_box_turn(q, is_a, gauss_map_get_normal(map, gauss_get_list(map, 1)[arc])),
                       gauss_box_place(q, is_a, gauss_get_list(map, 2)[arc])};
}

// The box's arc between two of its facets.
LANES_INLINE uint32_t gauss_box_find_arc(const gauss_map *map, uint32_t f, uint32_t g) {
    const uint8_t *from = gauss_get_list(map, 0), *to = gauss_get_list(map, 1);
    uint32_t found = 0;
    for (uint32_t arc = 0; arc < map->arcs; arc++)
        found |= (uint32_t)(((from[arc] == f) & (to[arc] == g)) | ((from[arc] == g) & (to[arc] == f))) << arc;
    return found ? (uint32_t)__builtin_ctz(found) : 0;
}

// Of the open arcs the one at a place, where it crosses the circle across axis k.
typedef struct gauss_box_crossing {
    uint32_t k, at;
} gauss_box_crossing;

// The plane of a crossing. 0 if the arcs as they are measured in gauss.h do not cross.
LANES_INLINE int gauss_box_take_crossing(const gauss_query *q, const gauss_box_arcs *found, gauss_box_crossing crossing,
                                         gauss_plane *out) {
    const uint32_t k = crossing.k, i = (k + 1) % 3, j = (k + 2) % 3, at = crossing.at;
    const double of_from = fabs(found->to[k][at]), of_to = fabs(found->from[k][at]);
    uint32_t f = gauss_box_get_facet(q, i, of_from * found->from[i][at] + of_to * found->to[i][at]),
             g = gauss_box_get_facet(q, j, of_from * found->from[j][at] + of_to * found->to[j][at]);
    const int is_a = q->box.side == 1;
    const uint32_t of_box = gauss_box_find_arc(is_a ? q->a.map : q->b.map, f, g);
    const uint32_t of_a = is_a ? of_box : found->list.arc[at], of_b = is_a ? found->list.arc[at] : of_box;
    const gauss_arc first = gauss_box_get_arc(q, 1, of_a), second = gauss_box_get_arc(q, 0, of_b);
    gauss_arcs others;
    gauss_search of = {GAUSS_SLACK * q->size, out, 0};
    others.count = 0;
    gauss_add_arc(&others, of_b, &second);
    gauss_end_arcs(&others);
    out->height = INFINITY;
    gauss_try_arc(&of, of_a, &first, &others);
    return out->height < INFINITY;
}

// The one plane that is clearly the lowest; 0 if there is none.
LANES_INLINE int gauss_box_take(const gauss_box_search *search, const gauss_box_arcs *arcs, gauss_plane *out) {
    const gauss_query *q = search->q;
    const double most = search->least + search->apart;
    gauss_box_crossing crossing = {0, 0};
    uint32_t facet = 0, face = 0, faces = 0, crossings = 0;
    uint32_t facets = gauss_box_count(search->height, search->facets, most, &facet);
    for (uint32_t i = 0; i < 6; i++)
        if (search->face[i] <= most) faces++, face = i;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t found = gauss_box_count(arcs->height[k], arcs->list.count, most, &crossing.at);
        if (found) crossing.k = k;
        crossings += found;
    }
    if (facets + faces + crossings != 1) return 0;
    if (crossings) return gauss_box_take_crossing(q, arcs, crossing, out);
    const int is_of_a = (q->box.side == 1) == (faces == 1);
    if (faces) facet = gauss_box_get_facet(q, face % 3, face < 3 ? 1 : -1);
    gauss_box_take_facet(q, is_of_a ? GAUSS_FACET_A : GAUSS_FACET_B, facet, out);
    return 1;
}

// GAUSS_OPEN where it is not clear.
LANES_INLINE gauss_found gauss_find_by_box(const gauss_query *q, gauss_plane *out) {
    gauss_box_search search;
    gauss_box_arcs arcs;
    search.q = q;
    search.hull = q->box.side == 1 ? &q->b : &q->a;
    search.facets = (uint32_t)simd_get_padded(search.hull->map->facets);
    search.apart = GAUSS_BOX_APART * q->size;
    if (!(search.hull->map->bulge < 0x1p-3 * search.apart) || !gauss_box_measure_facets(&search)) return GAUSS_OPEN;
    gauss_box_measure_faces(&search);
    if (search.least < q->claim - search.apart) return GAUSS_NONE;
    gauss_box_list_arcs(&search, &arcs);
    if (!gauss_box_measure_crossings(&search, &arcs)) return GAUSS_OPEN;
    if (!(search.least > q->claim + search.apart)) return GAUSS_OPEN;
    return gauss_box_take(&search, &arcs, out) ? GAUSS_FOUND : GAUSS_OPEN;
}
