// The tags of an XML text that is known to be well formed, with their places, so that a file can be written again with
// some of its elements replaced and everything else, comments and blanks too, as it was.
#ifndef OVOID_CLI_ROBOT_XML_TEXT_H
#define OVOID_CLI_ROBOT_XML_TEXT_H

#include <stddef.h>
#include <stdio.h>

/// A tag.
typedef struct xml_tag {
    const char *begin, *end; ///< from its '<' to behind its '>'
    const char *name;
    size_t name_size;
    int is_end;   ///< 1: "</name>"
    int is_empty; ///< 1: "<name/>"
} xml_tag;

/// The next tag from *at on; comments, CDATA, declarations and processing instructions are passed over. 0: there is
/// none.
int xml_find_tag(const char **at, const char *end, xml_tag *tag);

/// 1 if the tag has that name.
int xml_tag_is(const xml_tag *tag, const char *name);

/// Copies an attribute's value, the five entities of XML resolved. 0 where it has none, or it does not fit.
int xml_tag_read_attribute(const xml_tag *tag, const char *key, char *value, size_t room);

/// Writes a text as an attribute, a blank before it.
void xml_write_attribute(FILE *file, const char *key, const char *text);

#endif
