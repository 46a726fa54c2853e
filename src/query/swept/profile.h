// Two bodies of revolution, cylinders and cones, in the coordinates in which their overlap is simple. A's axis is u,
// the reverse of B's axis is v, and along a unit n with a = n.u and b = n.v each body reaches as far as a function of
// one number says:
//   h(n) = A(a) + B(b) - d.n,  d = p u + q v + m w,  w across both axes, m >= 0, so that
//   h(n) = [A(a) - p a] + [B(b) - q b] - m x,  x = n.w.
// What is in brackets is a part here. A has pieces: h a + r rho and -h a + r rho for a cylinder, rho = sqrt(1 - a^2),
// of which the first is the greater above the kink a = 0; h a and -h a + r rho for a cone, whose kink is the sine of
// its side's normals. Each piece is concave, and -m x is convex in a and b.
//
// Errors, in parts u s as in swept.c, with c and s the cosine and the sine of the axes: the numbers here are exactly
// those of bodies in which v is turned by 8 u, and d is moved by 16 u |d| / s. s is 1/16 at least: below 260 u.
#ifndef OVOID_QUERY_SWEPT_PROFILE_H
#define OVOID_QUERY_SWEPT_PROFILE_H

#include "base/compiler.h"
#include "query/swept/descend.h"

typedef struct profile {
    double height, radius; ///< half of the former
    double sine, cosine;   ///< of the side's normals, along the axis and across it
    int is_cone;
} profile;

/// What lies in the direction of a disc, or of an apex: the overlap along it, and how far the other body's deepest
/// point is within its rim.
typedef struct profile_end {
    double value, inside;
} profile_end;

typedef struct profiles {
    profile of[2];
    double c, s, scale;    ///< of the axes, 1 / s
    double lift;           ///< 1 / (1 + |c|)
    double along[2];       ///< p and q
    double m;              ///< of the centres across both axes
    vec3 u, t, w;          ///< v = c u + s t
    profile_end end[2][2]; ///< of each body, along the reverse of its axis and along that
    double size, tolerance;
    double least_square; ///< of x where a tangent is taken
    double value;        ///< the least overlap so far
    double low;          ///< what is to be shown
} profiles;

/// The cosine and the sine of an angle.
typedef struct profile_turn {
    double c, s;
} profile_turn;

/// Where an overlap may be the least: along the end of a body; on the circle of directions across the side of a body;
/// or across both sides.
typedef enum profile_kind { PROFILE_END, PROFILE_SIDE, PROFILE_CROSSING } profile_kind;

typedef struct profile_spot {
    profile_kind kind;
    int k;           ///< the body whose end or side it is
    int is_up;       ///< END: along the axis; SIDE: above the other body's kink
    profile_turn at; ///< SIDE: on the circle, from the nearest direction to the other body's axis
    double y[2], x;  ///< a and b, and x
    double value;
} profile_spot;

static inline double profile_find_rho(double a) { return sqrt(max2(0, (1 - a) * (1 + a))); }

/// How far a body reaches along a unit direction, which has those parts along its axis and across it.
COMPILER_INLINED double profile_find_reach(const profile *f, double a, double rho) {
    const double rim = f->radius * rho, along = f->height * a;
    return f->is_cone ? max2(along, rim - along) : fabs(along) + rim;
}

COMPILER_INLINED double profile_find_part(const profiles *q, int k, double a) {
    return profile_find_reach(&q->of[k], a, profile_find_rho(a)) - q->along[k] * a;
}

/// The radius of a piece's rim, 0 of an apex, and how far it is along the axis.
static inline double profile_find_rim(const profile *f, int is_up) { return is_up && f->is_cone ? 0 : f->radius; }
static inline double profile_find_height(const profile *f, int is_up) { return is_up ? f->height : -f->height; }

/// b of a direction on the circle across the side of k.
static inline double profile_find_other(const profiles *q, int k, profile_turn at) {
    return q->c * q->of[k].sine + q->s * q->of[k].cosine * at.c;
}

static inline profile_turn profile_unit(double c, double s) {
    const double scale = 1 / sqrt(c * c + s * s);
    return (profile_turn){c * scale, s * scale};
}

/// 0 if these coordinates do not serve: the axes are nearly parallel, or nearly in one plane.
int profiles_make(const cores *p, double tolerance, profiles *q);

/// The least overlap of bodies whose axes are parallel, to 512 u of the size, and its direction; 0 if they are not, or
/// the bodies are apart.
int profiles_search_parallel(const cores *p, profile_spot *to, vec3 *n);

/// The unit direction of a, b and x.
vec3 profiles_find_direction(const profiles *q, const double y[2], double x);

/// The least overlap along the ends and on the circles across the sides, from where they look to the other body.
int profiles_find_spot(const profiles *q, profile_spot *to);

/// One on such a circle that is near to a and b; 0 if none is found, or it is not less than `most`.
int profiles_find_spot_near(const profiles *q, const double y[2], double most, profile_spot *to);

// ---- the least of all (query/swept/revolved.c)

/// What is known of the overlaps along all directions beside that of a spot: none is less, by more than half of the
/// tolerance and 1400 u of the size; it is not known; one is less.
typedef enum held { HELD, OPEN, LOWER } held;

/// Sets the least overlap to that of the spot. lower: a and b of what is less.
held revolved_hold(profiles *q, const profile_spot *spot, double lower[2]);

/// 1 if each core is a cylinder or a cone.
int cores_are_revolved(const cores *p);

/// The least overlap of such cores: of *at the direction, the value and both points are set; no overlap is less than
/// the value by more than `tolerance` and 1400 u of the size. 0 if it is not found; then the direction and the value
/// are those of an overlap that is no more than others, or the value is INFINITY.
int cores_search_revolved(const cores *p, double tolerance, least_overlap *at);

#endif
