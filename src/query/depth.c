// The signed distance: how far apart, or how deep.
#include "exact/cover_memory.h"
#include "query/answer.h"

size_t ovoid_cover_get_size(uint32_t point_count) { return cover_get_memory_size(point_count); }

static ovoid_answer find(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                         ovoid_cover *cover, const ovoid_cover *kept) {
    const query_goal goal = query_goal_make_depth(options);
    if (!cover) return answer_find(pair, &(query_request){.options = options, .goal = &goal, .earlier = earlier});
    cover_clear(cover);
    if (!cover_has_memory(cover)) return answer_make_refused(OVOID_LIMIT_MEMORY);
    ovoid_options given = options ? *options : (ovoid_options){0, 0, 0, 0};
    given.iterations = cover_get_iterations(cover, given.iterations);
    return answer_find(
        pair, &(query_request){.options = &given, .goal = &goal, .earlier = earlier, .cover = cover, .kept = kept});
}

ovoid_answer ovoid_depth(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                         ovoid_cover *cover) {
    return find(pair, options, earlier, cover, NULL);
}

ovoid_answer ovoid_depth_from(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                              ovoid_cover *cover) {
    const ovoid_cover kept = cover ? *cover : (ovoid_cover){.point_count = 0};
    return find(pair, options, earlier, cover, kept.point_count ? &kept : NULL);
}
