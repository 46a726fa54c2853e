// The judge: decides in exact arithmetic (GMP) whether an answer's proof proves what the answer claims. It includes
// only <ovoid/*.h> and gmp.h, shares no code with the library and never searches: an answer whose proof does not
// suffice is rejected, even if the answer is true. A body is the hull of the polytope's vertices plus the radius, its
// pose the rational map position + R(q) x / |q|^2. docs/proofs.md has the theorems. When memory runs out the program
// ends, since GMP has no other way (judge_set_out_of_memory).
#ifndef OVOID_JUDGE_H
#define OVOID_JUDGE_H

#include "ovoid/body.h"
#include "ovoid/manifold.h"

/// Working numbers, and the facts proven about each shape's inner ellipsoid (by address: a shape that was seen must
/// live as long as the judge, or judge_forget must be called before it is destroyed). One thread at a time.
typedef struct judge judge;

/// NULL if memory runs out. The caller destroys it.
judge *judge_create(void);
void judge_destroy(judge *context);

/// Sets the function that any judge of the process calls when memory runs out: it must not return, as neither GMP nor
/// the judge can continue. NULL, and until this is called: abort. Call it before the first judge is made.
void judge_set_out_of_memory(void (*handler)(void));

/// Forgets all shapes.
void judge_forget(judge *context);

/// Sets the options of the queries: a bracket of status "touching" is at most as wide as their tolerance. NULL, and
/// until this is called: the default ones.
void judge_set_options(judge *context, const ovoid_options *options);

/// OVOID_OK if all claims of the answer are proven: lower by proof.normal, upper by proof.kind, the status, the unit
/// normal, and that the witness points lie on their bodies to rounding. Else OVOID_ERROR_PROOF (or INDEX, NOT_FINITE)
/// with a sentence in *error (may be NULL). cover: that of ovoid_depth, or NULL.
ovoid_code judge_verify_answer(judge *context, const ovoid_pair *pair, const ovoid_answer *answer,
                               const ovoid_cover *cover, ovoid_error *error);

/// OVOID_OK if all claims of the answer of a query of bodies (ovoid_body_distance and its sisters) are proven: the
/// deciding pair's answer with the bodies' lower bound, as in judge_verify_answer; that each exclusion's pairs of parts
/// are at least as far apart as it states, and no exclusion is nearer than the lower bound; and that the exclusions and
/// the deciding pair leave out no pair of parts. The relative tolerance of "touching" is of the bodies' size. Codes as
/// in judge_verify_answer; place: the exclusion, or -1. exclusions: those of the query; NULL is enough for two shapes.
/// Cost: the parts of all exclusions, some 15 us each. That the tree's order names each part once is checked too.
ovoid_code judge_verify_compound(judge *context, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                 const ovoid_exclusions *exclusions, ovoid_error *error);

/// As judge_verify_compound, for two bodies of which at least one is a solid: the deciding pair of triangles, each
/// exclusion by all points of its triangles, that they leave out no pair of triangles, containment by exact winding
/// numbers of all components, and a depth by all points along its direction. points: the deciding pair's, as in
/// judge_verify_points. Cost: the triangles of all exclusions, some microseconds each, and for each component all
/// triangles of the other body.
ovoid_code judge_verify_solid(judge *context, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                              const ovoid_exclusions *exclusions, int points, ovoid_error *error);

/// For answers of ovoid_distance that are apart and of ovoid_depth, to the default tolerance: point_b - point_a = d
/// normal, to what the bracket and the tolerance allow. OVOID_OK or OVOID_ERROR_PROOF.
ovoid_code judge_verify_points(judge *context, const ovoid_pair *pair, const ovoid_answer *answer, ovoid_error *error);

/// A contact with its whole polygon, as ovoid_manifold_compute_polygon gives it for the same options.
typedef struct judge_contact {
    const ovoid_manifold *manifold;
    const ovoid_manifold_polygon *polygon;
    double margin; ///< of the options
    double snap;   ///< how far a corner may be outside of a facet: a length
} judge_contact;

/// OVOID_OK if what a contact says of its points is true, all in exact arithmetic: `lower` is shown by the normal; each
/// pair of points lies on the bodies grown by polygon->grown, apart by the separation along the normal, and within the
/// margin (of bodies with an allowance: and that), but for the nearest points of features that do not overlap. Seen
/// along the normal, each corner is in both facets, to the snap; each corner of the facets' overlap within the margin
/// is at most five snaps outside of the polygon; where none of them is in doubt there are as many as are given. The
/// area in which the hulls of the bodies are within the margin and the radii is between inner and outer, and inner is
/// at most the area of the facets' overlap. `upper` is not looked at. A polygon without corners: `lower` alone. Else
/// OVOID_ERROR_PROOF with a sentence in *error (may be NULL). Facets of more than 64 vertices are not clipped.
ovoid_code judge_verify_contact(judge *j, const ovoid_pair *pair, const judge_contact *k, ovoid_error *error);

/// The truth about a pair of few vertices, by brute force over all features, independent of any proof.
typedef struct judge_truth {
    int core_sign;    ///< exact sign of the signed distance of the two hulls, without their radii
    int sign;         ///< exact sign of the signed distance, radii included
    double low, high; ///< low <= d <= high, neighbouring doubles or nearly so
} judge_truth;

/// Cost: about (vertices of A + vertices of B)^4; meant for at most 12 vertices each. OVOID_ERROR_LIMIT above 32.
ovoid_code judge_compute_truth(judge *context, const ovoid_pair *pair, judge_truth *truth, ovoid_error *error);

#endif
