// A manifold in the making. A body's patch is what of it is clipped: a facet, an edge or a vertex. Patches are seen
// along the normal n, from A to B: x and y are coordinates across it, the height z is along it. Lengths are those of
// the cores, without rounding radii. The bodies are in the order of order.c.
#ifndef OVOID_MANIFOLD_MANIFOLD_H
#define OVOID_MANIFOLD_MANIFOLD_H

#include "ovoid/manifold.h"
#include "pair/frame.h"
#include "shape/loops.h"
#include "simd/patch.h"

/// Corners nearer to each other than four times this part of the pair's size are one, and a corner that is outside of a
/// patch by less than it counts as inside.
#define MANIFOLD_SNAP 1e-6

/// The largest angle between a patch and the plane of contact, where the options leave it open.
#define MANIFOLD_ANGLE 1.45

/// Bits of the memory's flags.
enum {
    MANIFOLD_HAS_SEARCH = 1, ///< searched and pose are there
    MANIFOLD_EXCHANGED = 2   ///< the bodies were exchanged when the contact was found
};

static inline uint32_t feature_get_kind(uint32_t feature) { return feature & OVOID_MANIFOLD_KIND; }
static inline uint32_t feature_get_index(uint32_t feature) { return feature & ~OVOID_MANIFOLD_KIND; }

/// 1 if the feature is one of the shape.
int shape_has_feature(const ovoid_shape *shape, uint32_t feature);

/// The two ends of an edge.
typedef struct edge_ends {
    uint32_t from, to;
} edge_ends;
static inline edge_ends shape_get_ends(const ovoid_shape *s, uint32_t edge) {
    return (edge_ends){shape_edge_tails(s)[edge], shape_neighbors(s)[edge]};
}

/// What an axis is made of.
typedef struct manifold_axis {
    ovoid_manifold_axis kind;
    uint32_t a, b; ///< features
} manifold_axis;

/// The gap of the cores along a unit direction.
typedef struct gap_along {
    vec3 n, n_in_b;        ///< in the axes of A, and of B
    double tn;             ///< B's translation along it
    double gap;            ///< measured: off by at most the pair's check
    uint32_t low_a, low_b; ///< the vertices that are extreme toward the other body
} gap_along;
gap_along gap_measure_along(const pair_frame *frame, vec3 n);

/// A unit normal with the directions across it; n, u and v are right-handed.
typedef struct manifold_frame {
    const pair_frame *pair;
    vec3 n, u, v; ///< in the axes of A
    vec3 n_in_b, u_in_b, v_in_b;
    double tn, tu, tv;     ///< B's translation along them
    double gap;            ///< of the cores along n, measured: off by at most the pair's check
    uint32_t low_a, low_b; ///< the vertices that are extreme toward the other body
} manifold_frame;

/// What is clipped of a body, with its plane.
typedef struct manifold_patch {
    simd_patch at;
    uint32_t edges[PATCH_CORNERS]; ///< from a corner to the next
    double slope_x, slope_y;       ///< of the plane: z = z[0] + slope_x (x - x[0]) + slope_y (y - y[0])
    double steepness;              ///< one over the cosine of the angle between the plane's normal and n, not below 1
} manifold_patch;

static inline double patch_get_height(const manifold_patch *p, double x, double y) {
    return p->at.z[0] + (p->slope_x * (x - p->at.x[0]) + p->slope_y * (y - p->at.y[0]));
}
static inline double patch_get_side(const manifold_patch *p, uint32_t i, double x, double y) {
    return (p->at.side_x[i] * x + p->at.side_y[i] * y) - p->at.side_at[i];
}
/// A segment has one edge.
static inline uint32_t patch_get_edge_count(const manifold_patch *p) {
    return p->at.count > 2 ? p->at.count : p->at.count - 1;
}

/// A corner of the polygon.
typedef struct manifold_corner {
    double x, y;
    double separation; ///< of the patches there
    double outside;    ///< its distance from the patch that it is outside of, across the normal; 0 inside
    uint32_t id;
    uint32_t is_kept; ///< it is one of the earlier contact
} manifold_corner;

typedef struct manifold_polygon {
    uint32_t count;
    double area;  ///< across the normal
    double least; ///< an upper bound of the cores' distance, but for rounding, that a corner shows
    manifold_corner corners[OVOID_MANIFOLD_CORNERS];
} manifold_polygon;

/// Everything that the features of a contact say, before the four points are chosen.
typedef struct manifold_state {
    manifold_frame frame;
    uint32_t facet_a, facet_b; ///< the features of the patches
    manifold_patch a, b;
    simd_patch_table to_a, to_b; ///< B's corners to the sides of A; A's to those of B
    manifold_polygon polygon;
} manifold_state;

// ---- order.c: the order of the bodies ----

/// 1 if the bodies are to be exchanged: by their shapes, then their poses; or as the earlier contact was found.
int order_is_exchanged(const ovoid_pair *pair, const ovoid_manifold *earlier);
/// The pair in the other order.
static inline ovoid_pair pair_make_exchanged(const ovoid_pair *p) {
    return (ovoid_pair){p->shape_b, p->shape_a, p->pose_b, p->pose_a};
}

// ---- axis.c: the normal ----

/// The unit normal, in the axes of A, that the features make; where they make none, *n stays as it is. 0 if they are
/// not features of this pair or do not make such an axis.
int axis_compute_normal(const pair_frame *frame, const manifold_axis *axis, vec3 *n);

/// A vertex in the frame of the normal, with the operations of patch_kernels.place.
static inline vec3 frame_place_a(const manifold_frame *m, uint32_t vertex) {
    vec3 x = frame_vertex_a(m->pair, vertex);
    return (vec3){vec3_dot(m->u, x) + 0.0, vec3_dot(m->v, x) + 0.0, vec3_dot(m->n, x) + 0.0};
}
static inline vec3 frame_place_b(const manifold_frame *m, uint32_t vertex) {
    vec3 x = vec3_at(shape_vertices(m->pair->b), vertex);
    return (vec3){vec3_dot(m->u_in_b, x) + m->tu, vec3_dot(m->v_in_b, x) + m->tv, vec3_dot(m->n_in_b, x) + m->tn};
}

/// The frame of the unit normal along which a gap was measured.
void manifold_frame_make(const pair_frame *pair, const gap_along *along, manifold_frame *m);

/// The nearest points of two features, vertices or edges, in the frame of A; a facet counts as its first corner.
typedef struct feature_points {
    vec3 a, b;
} feature_points;
feature_points features_find_nearest(const pair_frame *frame, uint32_t feature_a, uint32_t feature_b);

// ---- choose.c: features after a search, and the facets that are clipped ----

/// The features that make a normal that a search found, to the tolerance in the gap; *along: measured along that
/// normal, and then along that of the features.
manifold_axis axis_choose(const pair_frame *frame, double tolerance, gap_along *along);

/// What is clipped of a body.
typedef struct facet_choice {
    vec3 n;        ///< toward the other body, in the body's axes
    uint32_t axis; ///< the body's feature of the axis
    uint32_t low;  ///< its vertex that is extreme along n
    uint32_t kept; ///< what was clipped last; it stays unless another facet faces n better by 1e-6 in the cosine
    int has_kept;
    double least; ///< the least cosine between a facet's normal and n
} facet_choice;
uint32_t facet_choose(const ovoid_shape *shape, const facet_choice *choice);

/// The edge at the vertex low, extreme along n, whose other end is not lower by more than `within`, as a feature;
/// UINT32_MAX if there is none.
uint32_t shape_find_low_edge(const ovoid_shape *shape, vec3 n, uint32_t low, double within);

// ---- patch.c, clip.c, reduce.c: the polygon ----

/// The patch of a feature of A, or of B.
void patch_make_a(const manifold_frame *m, uint32_t feature, manifold_patch *p);
void patch_make_b(const manifold_frame *m, uint32_t feature, manifold_patch *p);

/// Places a patch whose corners are listed, with its sides: of a facet the slopes are set afterwards.
void patch_place(const simd_placing *placing, manifold_patch *p);
/// The slopes of a facet whose unit normal has these coordinates in the frame of the manifold.
void patch_set_slope(manifold_patch *p, vec3 plane);

/// The square of a point's distance from the segment from the first of two corners to the second; x and y are columns.
static inline double segment_measure_square(const double *x, const double *y, vec3 at) {
    double dx = x[1] - x[0], dy = y[1] - y[0], px = at.x - x[0], py = at.y - y[0];
    double square = dx * dx + dy * dy, t = square > 0 ? (px * dx + py * dy) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    px -= t * dx;
    py -= t * dy;
    return px * px + py * py;
}

/// The distance of a point from a patch; 0 inside.
double patch_measure_distance(const manifold_patch *patch, double x, double y);

/// Which corners count.
typedef struct clip_rules {
    double snap;
    double most; ///< corners with a separation above this are left out
    double keep; ///< how far a kept corner may be outside
    const uint32_t *kept;
    uint32_t kept_count; ///< 0 where no corner is kept
} clip_rules;

/// The area of a polygon whose corners go around.
double polygon_compute_area(const manifold_polygon *polygon);

/// The polygon in which the patches of a state overlap, counter-clockwise; and its tables.
void patches_clip(manifold_state *state, const clip_rules *rules);

/// Where edge i of A crosses edge j of B; 0 if they do not cross.
typedef struct edge_crossing {
    uint32_t i, j;
    double x, y;
} edge_crossing;
int patches_cross(const manifold_patch *a, const manifold_patch *b, edge_crossing *crossing);
/// The id of a crossing.
uint32_t crossing_make_id(const manifold_patch *a, const manifold_patch *b, const edge_crossing *crossing);

/// At most four corners of a polygon, in its order.
typedef struct corner_choice {
    uint32_t count, index[4];
    double share; ///< of the polygon's area
} corner_choice;
/// Writes how many corners a polygon has, and which were chosen.
void corner_choice_write(const corner_choice *choice, const manifold_polygon *polygon, ovoid_manifold *out);
/// The deepest corner, to the snap, and those that span the most area with it. earlier: its corners are kept while
/// their share is within 2 % of what it was, and the deepest of them is the deepest of all to the slack.
corner_choice corners_choose(const manifold_state *state, const ovoid_manifold *earlier, double slack);
/// The place of the corner with an id, or -1.
int polygon_find_corner(const manifold_polygon *polygon, uint32_t id);
/// Do the numbers of points and corners and the share of a contact fit each other?
ovoid_code manifold_verify_counts(const ovoid_manifold *m, ovoid_error *error);
/// Are a contact's points corners of a polygon made again, in its order? Written: which.
ovoid_code manifold_verify_choice(const ovoid_manifold *m, const manifold_polygon *p, corner_choice *own,
                                  ovoid_error *error);
/// The share of the polygon's area that chosen corners span.
double polygon_compute_share(const manifold_polygon *polygon, const corner_choice *choice);

// ---- bounds.c: the upper bound ----

/// Stores the upper bound of a search and the pose it was found in.
void memory_set_search(ovoid_manifold_memory *memory, const ovoid_pair *pair, const pair_frame *frame, double upper);
/// The upper bound that an earlier search leaves at the present pose; infinity if there is none.
double memory_compute_upper(const ovoid_manifold_memory *memory, const pair_frame *frame);

/// Which depths are of use: from `enough` on none is better than another; those below `least` are of no use.
typedef struct depth_demand {
    double least, enough;
} depth_demand;

/// The depth of the cores that the features of the axis or the state's patches prove. Where that is less than the
/// least one demanded, it is some number below that: most contacts of corners and edges prove none, and end sooner.
double manifold_prove_depth(const manifold_state *state, const manifold_axis *axis, const depth_demand *demand);

// ---- points.c: corners as points of the bodies ----

/// How far rounding may put a point that was placed on a patch from the body.
double manifold_compute_rounding(const manifold_state *state);

/// How far from the bodies the points of a corner may be, without rounding.
double manifold_compute_excess(const manifold_state *state, const manifold_corner *corner);
/// What the rounding of world coordinates moves a point by.
double manifold_compute_world_rounding(const manifold_state *state);

/// The corner where patches that do not overlap are nearest, as far as the axis shows it.
manifold_corner manifold_make_nearest(const manifold_state *state, const manifold_axis *axis);

/// The frame and the patches, without the polygon, of a contact. 0 if it is not one of this pair. Bodies and contact
/// are in the order of order.c.
int manifold_open(const pair_frame *f, const ovoid_manifold *c, manifold_state *s);

/// The corner that an id names; 0 if there is none.
int manifold_find_corner(const manifold_state *s, const ovoid_manifold *c, uint32_t id, manifold_corner *corner);

/// The points of the corners that were chosen, in the caller's order of the bodies.
void manifold_write_points(const manifold_state *s, const corner_choice *chosen, int is_exchanged,
                           ovoid_manifold_points *out);

/// Corners as points of the world: affine in their place across the normal.
typedef struct corner_placing {
    vec3 origin, x, y, at; ///< a point of A is origin + (x p.x + y p.y + at)
    vec3 n;                ///< world
    double gap;            ///< of the cores: none is deeper
    double radii;
} corner_placing;
corner_placing corner_placing_make(const manifold_state *state);
ovoid_manifold_point corner_placing_get_point(const corner_placing *placing, const manifold_corner *corner);

/// The pair and its contact in the order of order.c; the bodies' sides of a point exchanged.
typedef struct ordered_pair {
    ovoid_pair pair;
    ovoid_manifold manifold;
    int is_exchanged;
} ordered_pair;
ordered_pair ordered_pair_make(const ovoid_pair *pair, const ovoid_manifold *c);
void point_exchange(ovoid_manifold_point *point);

// ---- find.c ----

/// The options with their defaults.
typedef struct manifold_terms {
    double margin, keep;
    double tolerance; ///< of the bracket, beside the allowances
    double slack;     ///< by which kept points may be less deep than the polygon: a tenth of the tolerance
    double least;     ///< the least cosine between a facet's normal and the axis
    ovoid_cover *cover;
    ovoid_manifold_points *points; ///< room for the points, or NULL
} manifold_terms;
/// 0 if the options are refused.
int manifold_options_are_valid(const ovoid_manifold_options *o);
int manifold_terms_make(const ovoid_manifold_options *given, const pair_frame *f, manifold_terms *t);

/// The polygon of the state's patches; the corner where they are nearest if they do not overlap.
void manifold_clip(const manifold_terms *terms, const manifold_axis *axis, const ovoid_manifold *earlier,
                   manifold_state *state);

/// An upper bound of the signed distance by a state whose polygon is there.
double manifold_compute_points_upper(const manifold_state *state);

/// ovoid_manifold_find for callers inside a public function.
void manifold_find_internal(const ovoid_pair *pair, const ovoid_manifold_options *options,
                            const ovoid_manifold *earlier, ovoid_manifold *out);
/// ovoid_manifold_compute_points, too.
void manifold_compute_points_internal(const ovoid_pair *pair, const ovoid_manifold *c, ovoid_manifold_points *out);

#endif
