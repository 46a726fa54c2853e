// A convex part beside a solid, for contacts. The part is body A, the solid body B, and the frame is the part's. A
// contact is one of the part and a flat facet of the solid (solid/facets.c): along the facet's normal, or, where the
// part touches an edge or a corner of the facet, along a normal between those of the facets there.
#ifndef OVOID_BODY_MANIFOLDS_SOLID_PAIR_H
#define OVOID_BODY_MANIFOLDS_SOLID_PAIR_H

#include "body/body_tree.h"
#include "body/manifolds/body_manifolds.h"
#include "manifold/manifold.h"

typedef struct solid_pair {
    const ovoid_solid *solid;
    const ovoid_pose *pose; ///< of the solid
    ovoid_posed_shape part;
    pair_frame frame;
    vec3 center;         ///< of the part, in the solid's frame: it tells the side of a surface that is not closed
    double snap;         ///< lengths across the normal below this are none, as in manifold.h
    double slack;        ///< by what the verifier allows more than the query does in what rounding may change: 1, or 2
    triangle_shape room; ///< stands for the solid in the frame: one point of it
} solid_pair;

/// Why the pair is refused, or NONE. The pair must not be moved.
ovoid_limit solid_pair_make(solid_pair *p, const ovoid_posed_shape *part, const ovoid_body *solid);

/// A direction of the frame, or a point, in the solid's frame.
static inline vec3 solid_pair_get_direction(const solid_pair *p, vec3 n) {
    return mat3_mul_transposed_vec3(p->frame.rotation, n);
}
static inline vec3 solid_pair_get_point(const solid_pair *p, vec3 x) {
    return solid_pair_get_direction(p, vec3_sub(x, p->frame.translation));
}

/// A box in the tree's frame and unit, as box8_begin takes it: of the part grown by `more`; of a ball in the solid's
/// frame.
typedef struct tree_ends {
    double ends[6];
} tree_ends;
tree_ends solid_pair_make_ends(const solid_pair *p, double more);
tree_ends solid_make_ends(const ovoid_solid *solid, vec3 center, double radius);

/// The triangles whose boxes meet a box, in the order of the tree.
typedef struct place_walk {
    box8_walk walk;
    uint32_t places[64], count, at;
} place_walk;
void place_walk_begin(place_walk *w, const ovoid_solid *solid, const tree_ends *ends);
/// The next place, or UINT32_MAX.
uint32_t place_walk_get_next(place_walk *w);

/// The point of a triangle that is nearest to a point.
vec3 solid_find_nearest(const ovoid_solid *solid, uint32_t place, vec3 x);

/// A facet's plane, in the solid's frame; the normal is outward, of a surface that is not closed toward the part.
typedef struct facet_plane {
    uint32_t facet;
    vec3 normal, point;
    int is_turned; ///< the normal is not the one for which the triangles are counter-clockwise
} facet_plane;
facet_plane solid_pair_get_plane(const solid_pair *p, uint32_t facet);
/// The normal from the part to the solid, in the frame, that goes against an outward normal of the solid's frame.
static inline vec3 solid_pair_turn_normal(const solid_pair *p, vec3 outward) {
    return vec3_neg(mat3_mul_vec3(p->frame.rotation, outward));
}
/// How far the part is from the plane across a normal of the frame through a point of the solid: cores alone.
double solid_pair_measure_gap(const solid_pair *p, vec3 n, vec3 point);

// ---- facet_clip.c

/// What is clipped: along a unit normal of the frame a feature of the part, and a facet, or an edge or vertex of the
/// solid where that faces the normal too little. Edges of solids are 3 t + i, the i-th of the caller's triangle t.
typedef struct facet_contact {
    ovoid_manifold_axis axis;
    vec3 n;
    uint32_t facet_a;
    uint32_t facet_b;
    facet_plane plane; ///< of the facet next to the contact
} facet_contact;

/// The least separations among a contact's corners, of the cores; infinity if there is none.
typedef struct facet_depths {
    double least;   ///< of all
    double vertex;  ///< of the part's vertices over the facet: there the part is deepest of all
    double concave; ///< of those at an edge where the solid rises
    double most;    ///< the largest separation that counts
    uint32_t first; ///< the place of the facet's first triangle in the box
} facet_depths;

/// The frame and the patches of a contact, without its corners. 0: it is no contact of this pair.
int facet_contact_open(solid_pair *p, const facet_contact *c, manifold_state *s);
/// How a contact is clipped. ends: the box in which the facet's triangles are looked for.
typedef struct facet_clip {
    const facet_contact *contact;
    const clip_rules *rules;
    const tree_ends *ends;
} facet_clip;
/// And its corners: their convex hull across the normal. The facet need not be convex, so between them there may be
/// points without contact.
int facet_contact_clip(solid_pair *p, const facet_clip *clip, manifold_state *s, facet_depths *depths);
/// A place in the frame of the normal, in the solid's frame.
static inline vec3 facet_contact_place(const solid_pair *p, const manifold_state *s, vec3 at) {
    vec3 x = vec3_add(vec3_scale(s->frame.u, at.x), vec3_scale(s->frame.v, at.y));
    return solid_pair_get_point(p, vec3_add_scaled(x, s->frame.n, at.z));
}
/// The corner that an id names; 0 if there is none. The state is open.
typedef struct facet_corner_query {
    const solid_pair *pair;
    const facet_contact *contact;
    manifold_state *state;
} facet_corner_query;
int facet_contact_find_corner(const facet_corner_query *query, uint32_t id, manifold_corner *corner);

// ---- solid_contact.c

/// The contact that a manifold of the pair claims; 0 if its features make none. The manifold's body A is the part.
int facet_contact_read(solid_pair *p, const ovoid_body_manifold *item, facet_contact *c);

/// Which corners count; earlier: the facet's last manifold, or NULL.
clip_rules facet_contact_make_rules(const solid_pair *p, const manifold_terms *t, const ovoid_manifold *earlier);

/// Is the solid nowhere higher than at a point, along a direction of its frame, as far as its triangles reach that hold
/// the point? Then *best is the facet there that faces the direction most.
int solid_pair_is_top(const solid_pair *p, vec3 x, vec3 up, facet_plane *best);

/// Is the solid nowhere higher beside the corner of a state that is nearest to the part? Along its facet's normal
/// another rule holds, and this is 1.
int facet_contact_is_top(const solid_pair *p, const facet_contact *c, const manifold_state *s);

/// Does a contact along its facet's normal count? *is_through: where it does not, the part has gone through the solid.
int facet_contact_counts(const solid_pair *p, const facet_contact *c, const manifold_state *s, const facet_depths *d,
                         int *is_through);

/// The bracket along the normal with status, limit and proof, from the first out->count corners of the state.
void facet_contact_measure(const solid_pair *p, const manifold_terms *t, const manifold_state *s, ovoid_manifold *out);

/// The points of the first corners of the state. None is deeper than the bodies are along the normal.
typedef struct points_order {
    uint32_t count;
    int is_exchanged; ///< the caller's body A is the solid
} points_order;
void facet_contact_write_points(const solid_pair *p, manifold_state *s, const points_order *order,
                                ovoid_manifold_points *out);

/// ovoid_body_manifold_compute_points and ovoid_body_manifold_verify of such a pair.
void solid_manifold_compute_points(const ovoid_body_pair *pair, const ovoid_body_manifold *item,
                                   ovoid_manifold_points *points);
ovoid_code solid_manifold_verify(const ovoid_body_pair *pair, const ovoid_body_manifold *item,
                                 const ovoid_manifold_options *options, ovoid_error *error);

// ---- solid_manifolds.c

/// body_manifolds_find_internal of a pair of which one body is a solid; the request's options are valid.
ovoid_limit solid_manifolds_find(const ovoid_body_pair *pair, const manifolds_request *request, manifolds_found *found);

#endif
