// The sorts behind facets and polygons against the definition: keys ascend, and equal keys keep their order. Every
// number of entries up to 300 meets runs that are cut short, and both ways of sorting.
#include "check.h"
#include "polytope/sort.h"

enum { MOST = 300 };

static void check_entries(uint32_t count, uint64_t kinds) {
    static sort_entry entries[2 * MOST];
    for (uint32_t i = 0; i < count; i++) entries[i] = (sort_entry){random_next(&check_seed) % kinds << 30, i};
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
    for (uint32_t count = 0; count <= MOST; count++) {
        check_entries(count, 7);
        check_entries(count, UINT64_C(1) << 32);
    }
    return check_end();
}
