// The signed distance: how far apart, or how deep.
#include "base/error.h"
#include "exact/expand.h"
#include "query/answer.h"

ovoid_answer ovoid_depth(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                         ovoid_cover *cover) {
    const query_goal goal = query_goal_make_depth(options);
    return answer_find(pair, &(query_request){options, &goal, earlier, cover});
}

// The caller's memory: what aligns it, a cover of the search's own memory, the room for a surface beyond that.
enum { ALIGNMENT = 64, COVER_SIZE = (sizeof(ovoid_cover) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT };

size_t ovoid_depth_get_memory_size(uint32_t point_count) {
    if (point_count > OVOID_COVER_POINTS_MAX) return 0;
    uint32_t points = point_count > OVOID_COVER_POINTS ? point_count : OVOID_COVER_POINTS;
    return ALIGNMENT + COVER_SIZE + expansion_get_room_size(points);
}

// The most points of a surface in that many bytes.
static uint32_t find_points(size_t size) {
    if (size >= ovoid_depth_get_memory_size(OVOID_COVER_POINTS_MAX)) return OVOID_COVER_POINTS_MAX;
    return (uint32_t)((size - ALIGNMENT - COVER_SIZE) / expansion_get_room_size(1));
}

ovoid_answer ovoid_depth_with(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                              ovoid_depth_memory *memory) {
    OVOID_ASSERT(memory);
    memory->cover = (ovoid_large_cover){.point_count = 0};
    if (!memory->data || memory->size < ovoid_depth_get_memory_size(OVOID_COVER_POINTS))
        return answer_make_refused(OVOID_LIMIT_MEMORY);
    char *data = (char *)memory->data + (ALIGNMENT - (uintptr_t)memory->data % ALIGNMENT) % ALIGNMENT;
    ovoid_cover *cover = (ovoid_cover *)(void *)data;
    depth_room room = {.data = data + COVER_SIZE, .points = find_points(memory->size)};
    ovoid_options given = options ? *options : (ovoid_options){0, 0, 0, 0};
    if (given.iterations == 0) given.iterations = 2 * room.points;
    query_goal goal = query_goal_make_depth(options);
    goal.room = &room;
    ovoid_answer answer = answer_find(pair, &(query_request){&given, &goal, earlier, cover});
    memory->cover = room.cover.point_count ? room.cover : cover_get_large(cover);
    return answer;
}
