// A path is asked again with more room where its proof has more steps than there was room for; the answer is the same.
#include "robot/path/answer.h"

#include "base/message.h"

#include <stdlib.h>

/// Steps for which there is room at first.
#define STEPS_ROOM 4096

ovoid_robot_step *path_create_steps(void) { return malloc(STEPS_ROOM * sizeof(ovoid_robot_step)); }

int path_find_answer(path_report *r, ovoid_robot_checker *checker, const ovoid_robot_path *path,
                     ovoid_robot_path_options *o) {
    ovoid_error error;
    size_t room = r->steps ? STEPS_ROOM : 0;
    for (;;) {
        o->steps = r->steps;
        o->capacity = room;
        ovoid_robot_checker_reset(checker);
        if (ovoid_robot_path_find_hit(checker, &(ovoid_robot_path_query){path, o}, &r->answer, &error) != OVOID_OK)
            return message_error("%s", error.message), EXIT_INPUT;
        if (!r->steps || r->answer.step_count <= room) return 0;
        room = r->answer.step_count;
        free(r->steps);
        r->steps = malloc(room * sizeof *r->steps);
        if (!r->steps) return message_error("out of memory for %zu steps", room), EXIT_INPUT;
    }
}

int path_check_proofs(const path_report *r, const ovoid_robot_path *path, const ovoid_robot_path_options *o) {
    ovoid_error error;
    size_t count = r->answer.step_count;
    if (r->answer.status == OVOID_ROBOT_REFUSED) {
        if (!r->is_edge) message_note("nothing is proven of a path that is refused");
        return 0;
    }
    if (ovoid_robot_path_verify(r->cell->cell, &r->answer, &(ovoid_robot_path_basis){{path, o}, r->steps}, &error) !=
        OVOID_OK) {
        message_error("path %zu: of %zu proofs not all hold: %s", r->number, count, error.message);
        return EXIT_NOT_PROVEN;
    }
    const char *until = r->answer.status == OVOID_ROBOT_FREE ? "free up to" : "free before";
    if (r->is_edge) return 0;
    message_note("%zu of %zu proofs hold: %s s %.9g%s", count, count, until, r->answer.free_until,
                 r->answer.status == OVOID_ROBOT_HIT ? ", and the hit" : "");
    return 0;
}
