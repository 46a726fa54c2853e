// The bodies and pairs of a page, and how bodies are written.
#ifndef OVOID_CLI_PAGE_BODIES_H
#define OVOID_CLI_PAGE_BODIES_H

#include "base/inputs.h"
#include "page/page.h"

#include <ovoid/ovoid.h>

/// A candidate body for a page.
typedef struct page_body {
    const char *name;
    ovoid_body body;           ///< of a solid its hull
    const ovoid_solid *solid;  ///< NULL: the body is not a solid
    ovoid_convexity convexity; ///< of its mesh
    mesh_source mesh;
} page_body;

/// The objects of a scene; the caller frees them. NULL after a message.
page_body *page_bodies_list(const ovoid_scene *scene);

/// A pair that is on the page, by its objects and its place among those given.
typedef struct page_pair {
    ovoid_couple couple;
    size_t given;
} page_pair;

/// The number of an object that is not on the page.
#define PAGE_NO_NUMBER UINT32_MAX

/// The bodies and pairs of a page.
typedef struct page_choice {
    uint32_t *numbers; ///< of each object: on the page, or PAGE_NO_NUMBER
    uint32_t *near;    ///< `count` objects, those of the nearest pairs first
    size_t object_count, count;
    page_pair *pairs; ///< in the order given
    size_t pair_count;
} page_choice;

/// Couples of objects, `stride` bytes apart, the nearest first.
typedef struct page_couples {
    const void *items; ///< ovoid_couple
    size_t stride, count;
} page_couples;

/// Chooses at most 10 000 objects and 20 000 pairs; the objects of the nearest pairs come first, then others in their
/// order. Objects and pairs that are left out are counted. 0, or EXIT_INPUT after a message.
int page_choose(cli_page *page, size_t object_count, const page_couples *couples, page_choice *choice);
void page_choice_clear(page_choice *choice);

/// Writes "shapes" and "bodies". bodies: all objects. 0, or EXIT_INPUT after a message.
int page_write_bodies(cli_page *page, const page_body *bodies, const page_choice *choice);

#endif
