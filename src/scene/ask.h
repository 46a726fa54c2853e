// A frame's question of one pair: the query, what is kept of it, how long it lasts.
#ifndef OVOID_SCENE_ASK_H
#define OVOID_SCENE_ASK_H

#include "scene/compound.h"
#include "scene/state.h"

/// The question of a frame, ready for the query floor.
question ask_make(const ovoid_frame_query *query);

/// The query itself at the present poses, warm from what is kept (NULL: cold).
void ask_pair(const ovoid_world *w, uint32_t a, uint32_t b, const kept *k, question ask, ovoid_exclusions *exclusions,
              ovoid_compound_answer *out);

/// How long what is kept answers the world's question: sets kind, v, c and CONTACT.
void pair_set_age(const ovoid_world *w, world_pair *p, const kept *k);

/// Asks anew, keeps the answer and sets its age.
void pair_ask(ovoid_world *w, world_pair *p);

/// How far the signed distance can have changed since what is kept was found, rounding included.
double pair_compute_age(const ovoid_world *w, const world_pair *p, const kept *k);

/// What is kept, measured again at the present poses: 1 if it still answers; the bounds of k are then those of now.
int pair_measure(const ovoid_world *w, const world_pair *p, kept *k);

/// 1 if what is kept still answers; no geometry is looked at.
int pair_is_answered(const ovoid_world *w, const world_pair *p);

/// What is reported.
ovoid_contact pair_make_contact(const ovoid_world *w, const world_pair *p);

#endif
