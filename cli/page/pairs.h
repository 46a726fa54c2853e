// The pairs of a page: their numbers, and their answers in the JSON of results.
#ifndef OVOID_CLI_PAGE_PAIRS_H
#define OVOID_CLI_PAGE_PAIRS_H

#include "page/bodies.h"
#include "pairs/answers.h"

/// A list of pairs under construction.
typedef struct page_pairs {
    cli_page *page;
    FILE *file;              ///< of the page
    const uint32_t *numbers; ///< of objects
    size_t count;            ///< written so far
    size_t frame;            ///< of a motion; PAGE_NO_FRAME: none
    size_t proof_bytes;      ///< of all proofs
} page_pairs;

#define PAGE_NO_FRAME ((size_t)-1)

page_pairs page_pairs_begin(cli_page *page, const page_choice *choice);

/// Answers and writes pairs of a scene, the nearest first. Above 20 MB of proofs, further proofs are left out and
/// counted, since the page can compute them. The members of the job are set; its couples are those of `pairs`. 0, or an
/// exit code after a message.
int page_pairs_add(page_pairs *list, const answers_job *job, const page_pair *pairs, size_t count);

/// Writes one pair from its record, which has margin and parts. 0, or EXIT_INPUT after a message.
int page_pairs_add_record(page_pairs *list, ovoid_couple couple, const ovoid_record *record);

void page_pairs_end(page_pairs *list);

#endif
