// The sorts behind facets and polygons against the definition: keys ascend, and equal keys keep their order, for every
// number of entries up to 300 and some beyond that from which another way of sorting is taken. Keys fill the slots of
// the distribution evenly, or nearly all fall into one, in which moving them takes too long.
#include "check.h"
#include "polytope/sort.h"

enum { EACH = 300, MOST = 5000 };

// far: the first key is that much larger than the others.
static void check_entries(uint32_t count, uint64_t kinds, uint64_t far) {
    static sort_entry entries[2 * MOST];
    for (uint32_t i = 0; i < count; i++)
        entries[i] = (sort_entry){(random_next(&check_seed) % kinds << 30) + (i == 0 ? far : 0), i};
    sort_entries(entries, entries + count, count);
    uint64_t sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        sum += entries[i].index;
        if (i == 0) continue;
        CHECK(entries[i - 1].key < entries[i].key ||
              (entries[i - 1].key == entries[i].key && entries[i - 1].index < entries[i].index));
    }
    CHECK_EQ(sum, (uint64_t)count * (count ? count - 1 : 0) / 2);
}

int main(void) {
    check_seed = 1;
    for (uint32_t count = 0; count <= MOST; count += count < EACH ? 1 : 1175) {
        check_entries(count, 7, 0);
        check_entries(count, UINT64_C(1) << 32, 0);
        check_entries(count, UINT64_C(1) << 20, UINT64_C(1) << 62);
    }
    return check_end();
}
