// The template of a page: the file page.html, which `make page` builds, with one place for the data.
#ifndef OVOID_CLI_PAGE_TEMPLATE_H
#define OVOID_CLI_PAGE_TEMPLATE_H

#include <stddef.h>

/// The text that the data replace, exactly once.
#define PAGE_MARK "<!--ovoid-data-->"

/// A template in memory.
typedef struct page_template {
    char *text;
    size_t size, mark; ///< mark: where PAGE_MARK begins
} page_template;

/// Finds and reads the template: the file that the environment variable OVOID_PAGE names; without one, page.html in the
/// folder of this program, then in ../share/ovoid from that folder. 0, or EXIT_INPUT after a message.
int page_template_read(page_template *template);
void page_template_clear(page_template *template);

#endif
