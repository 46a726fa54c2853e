// Bodies in single precision, sixteen couples side by side. A yes or no: spheres, ellipsoids, then GJK of small bodies,
// which ends each couple proven apart, proven within the margin, proven to overlap, or open. The vertices are columns
// too, so a support is a maximum over them without an index: no gather, no load that waits for an index. Of bodies of
// more vertices the caller finds the supports, step by step, for the lanes at work alone.
//
// Nearest points: GJK that proves nothing, but counts which vertices its corners are of. Each couple ends near, at a
// simplex whose support is one of its own corners or is no nearer; with the origin inside of four corners; or open. The
// caller makes and proves the answer from the corners, in doubles.
//
// Lengths are in the couple's own unit, a power of two, so that its size z = ra + rb + |t| is in [1, 2): ra, rb the
// radii of the enclosing spheres, t from A's centre to B's. Everything is in the axes of A about its sphere's centre: a
// point of B is M x + t. Nothing overflows, and what underflows is below 2^-100.
//
// Errors, in parts of u z with u = 2^-24, |n| = 1 (docs/error-analysis.md has the sums): a gap along n 19, a difference
// 11, a convex combination of differences and its norm 22. FLOAT_CLAIM is above each. Where the numbers of a couple are
// made in floats too (`spheres`), B is off its place by 51 rb + 29 |t| + 29 (ea + eb) + |p_b - p_a| more: ea, eb are
// the extents around the frames' origins, which are at p_a and p_b, and s is ea + eb + |p_b - p_a|.
//
// Cost, a couple, one core at 2.8 GHz, AVX-512: 6 ns and 1 ns a step at 8 vertices, 9 ns and 3 ns at 32.
#ifndef OVOID_SIMD_FLOAT_GJK_H
#define OVOID_SIMD_FLOAT_GJK_H

#include "simd/support.h"

#include <stddef.h>

enum { FLOATS = 16, FLOATS_ALL = 0xffff };

/// Most vertices of a body, and most eights of them.
enum { FLOAT_GJK_POINTS = 32, FLOAT_GJK_BLOCKS = FLOAT_GJK_POINTS / 8 };

/// Most vertices of a shape that has columns of its own: from some number on a table of supports is faster.
enum { FLOAT_COLUMN_POINTS = 96 };

/// The error of all bounds, of z.
#define FLOAT_CLAIM (32 * 0x1p-24)

/// What is beyond these lengths, or of z below that part of s, is not for `spheres`.
#define FLOAT_LENGTH_MIN 0x1p-40
#define FLOAT_LENGTH_MAX 0x1p40
#define FLOAT_PART_MIN 0.0625

/// One number of each couple.
typedef struct float_column {
    _Alignas(64) float lane[FLOATS];
} float_column;

/// What is asked of each couple, in its unit.
typedef struct float_query {
    float_column rotation[9], translation[3]; ///< M by rows, t
    float_column claim;                       ///< FLOAT_CLAIM z, and what doubles add to it
    float_column far, near;                   ///< ends apart when lower > far, near when 0 < lower and upper <= near
    float_column id;                          ///< of the caller; is only moved
    float_column size, scale;                 ///< z; into the couple's unit; read by `ellipsoids` alone
    float_column factor_a, factor_b;          ///< from the shapes' units: powers of two, or 0; written by `ellipsoids`
    float_column start[3];                    ///< the first direction; written by `ellipsoids`
} float_query;

/// The columns of a query; of these those from the rotation to the claim, and those that `ellipsoids` reads.
enum {
    FLOAT_COLUMNS = sizeof(float_query) / sizeof(float_column),
    FLOAT_NUMBERS = 13,
    FLOAT_GIVEN = FLOAT_COLUMNS - 5
};

/// Columns of couples that wait, the first `count`: room for a group, and for those that are added to fifteen.
typedef struct float_queue {
    _Alignas(64) float columns[FLOAT_COLUMNS][2 * FLOATS];
    unsigned count;
} float_queue;

/// What a shape has in single precision, in a unit of its own. The columns of its vertices follow: x of padded_count
/// vertices, y, z.
typedef struct float_shape {
    _Alignas(32) float row[24]; ///< by FLOAT_OUTER and its sisters
    double unit;                ///< a power of two
} float_shape;

/// The places of the ellipsoids' numbers: outer: centre xyz, Q (xx xy xz yy yz zz); the unit, where floats have it;
/// inner: centre, W (shape_inner), a lower bound of its least radius or, where W must not be used, 0.
enum { FLOAT_OUTER = 0, FLOAT_OUTER_Q = 3, FLOAT_UNIT = 9, FLOAT_INNER = 10, FLOAT_INNER_W = 13, FLOAT_LEAST = 19 };

/// The shapes of the lanes at work; the others repeat some of them.
typedef struct float_shapes {
    const float_shape *a[FLOATS], *b[FLOATS];
} float_shapes;

/// The vertices of couples, and how many eights each body has.
typedef struct float_points {
    const float *a[FLOATS], *b[FLOATS];
    uint32_t blocks_a[FLOATS], blocks_b[FLOATS];
} float_points;

/// The places of the numbers of the lanes' bodies and shapes, as in pair8_places, and the sums of the shapes' extents;
/// the other lanes repeat some of them. What is asked, rounded outward.
typedef struct float_rows {
    const double *pose_a[FLOATS], *pose_b[FLOATS], *shape_a[FLOATS], *shape_b[FLOATS];
    double extents[FLOATS];
    float far, near;
} float_rows;

/// What the enclosing spheres say, in the bodies' unit of length. The bounds are of the lanes apart or open.
typedef struct float_spheres {
    float_column lower, upper;
    float_column size; ///< s
    float_column unit; ///< of lanes that are open, a power of two
    unsigned apart;    ///< lower > far
    unsigned open;     ///< the others that may go on
} float_spheres;

/// What the ellipsoids say. The bounds of the others are not written.
typedef struct float_bounds {
    float_column lower, upper; ///< lower of lanes apart, upper of those that overlap
    unsigned apart, inside;
} float_bounds;

/// What `approach` ends with: the vertices of the corners, a + 32 b, one to three, and of those inside a fourth. Places
/// of the three that are none repeat the first.
typedef struct float_found {
    float_column corner[4], count, steps; ///< steps: the corners that were found after the first, and taken
} float_found;

/// The vertices: x of 8 blocks, then y, then z.
typedef struct float_columns {
    float_column a[3 * FLOAT_GJK_POINTS], b[3 * FLOAT_GJK_POINTS];
} float_columns;

/// A search whose caller finds the supports. The second and the third are near the first one's direction.
typedef struct float_given {
    float_column a[3], b[3];  ///< the vertices; b: before, the directions in the axes of B
    float_column heading[3];  ///< of the simplex; n may be another direction
    float_column other[3];    ///< the direction of the third support
    float_column waits, tilt; ///< how many of these two are to come; their angle from n, set by the caller
} float_given;

/// Sixteen searches, each at a step of its own.
typedef struct float_gjk {
    float_query query;
    float_column old[9], is_valid[3]; ///< the simplex's differences; its truth values in the sign bits
    float_column n[3];                ///< the direction of the next support
    float_column height, square;      ///< the simplex's nearest point is at height / |heading| along its heading: n
    float_column steps;               ///< the supports after the first
    float_column lower, upper;        ///< the bounds of lanes that ended; lower not of those that overlap
    float_found found;                ///< by `approach`
    union {
        float_columns columns;
        float_given given;
    };
    /// Of both bodies of all couples, 1 to FLOAT_GJK_BLOCKS; 0: supports are given. Set by the caller.
    uint32_t blocks;
    unsigned live; ///< lanes that are at work
    float most;    ///< steps; set by the caller
} float_gjk;

/// How lanes ended; the others go on.
typedef struct float_ends {
    unsigned apart, near, inside, open;
} float_ends;

/// Kernels of one instruction set; `lanes` is a mask. Lanes cost nothing where a whole vector of them is idle. Those
/// for one couple have its lane 0 alone, and `advance` searches it to its end where there are blocks.
typedef struct float_gjk_kernels {
    unsigned width; ///< so many lanes are read at once, whichever of them are at work
    /// The enclosing spheres of the lanes, first those around the frames' origins, which need no rotation; of lanes
    /// that are open the query, down to the scale without the id. For bodies without radii.
    void (*spheres)(const float_rows *from, unsigned lanes, float_query *query, float_spheres *out);
    /// The ellipsoids of the lanes, the factors from the shapes' units, and the directions from which searches begin.
    void (*ellipsoids)(const float_shapes *from, unsigned lanes, float_query *query, float_bounds *out);
    /// Appends the lanes to a queue of less than FLOATS couples.
    void (*append)(const float_query *from, unsigned lanes, float_queue *to);
    /// Moves the last couples of a queue, in their order, into the lanes, which were idle and are at work now.
    void (*fill)(float_queue *from, unsigned lanes, float_gjk *to);
    /// Reads the vertices of the lanes. The rows of the others are of some body.
    void (*load)(const float_points *from, unsigned lanes, float_gjk *to);
    /// The directions of the supports of B, in its axes, of the lanes at work, where these are given.
    void (*turn)(float_gjk *s);
    /// The vertex of one body extreme along n: the lowest index of equal ones. columns: of `count`, a multiple of 8,
    /// from 8 to FLOAT_COLUMN_POINTS.
    uint32_t (*find)(const float *columns, uint32_t count, const float n[3]);
    /// A support and a step of all lanes at work. Lanes that end are idle. Without blocks the supports are
    /// given: a vertex extreme along n, and one along what `turn` found, the other way; this is one step of couples
    /// alone, too.
    float_ends (*advance)(float_gjk *s);
    /// Searches the lanes for nearest points, from the line of centres to the end: near, inside or open. Of their
    /// queries only the rotation, translation and claim are read.
    float_ends (*approach)(float_gjk *s, unsigned lanes);
    /// `advance` that counts too which vertices the corners are of: in `found` the four of lanes that end inside.
    float_ends (*advance_named)(float_gjk *s);
} float_gjk_kernels;

/// The kernels for so many couples: of the widest instruction set of this machine that they fill.
const float_gjk_kernels *float_gjk_get_kernels(size_t couples);

/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const float_gjk_kernels *float_gjk_get_kernels_of(simd_isa isa);

#endif
