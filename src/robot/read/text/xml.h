// An XML file as a tree of elements with their lines. No entity is ever expanded but the five of XML itself.
#ifndef OVOID_ROBOT_READ_TEXT_XML_H
#define OVOID_ROBOT_READ_TEXT_XML_H

#include "robot/read/text/pool.h"

/// Most bytes of a file, and how deep its elements are nested at most.
#define XML_SIZE_MAX ((size_t)1 << 26)
#define XML_DEPTH_MAX 64

typedef struct xml_attribute {
    const char *name, *value;
    struct xml_attribute *next;
} xml_attribute;

typedef struct xml_element {
    const char *name;
    int64_t line;
    const char *text; ///< what stands in it before its first child, or ""
    const xml_attribute *attributes;
    struct xml_element *parent, *first, *last, *next;
} xml_element;

/// Reads the file ("-": standard input); all of the tree is in the pool.
ovoid_code xml_read(const char *path, pool *memory, xml_element **root, ovoid_error *error);

/// Reads a text of at most XML_SIZE_MAX bytes, which errors name by the path.
ovoid_code xml_read_text(const char *path, bytes text, pool *memory, xml_element **root, ovoid_error *error);

/// The value of an attribute, or NULL.
const char *xml_get(const xml_element *element, const char *name);
/// The first child of that name, or NULL.
const xml_element *xml_find(const xml_element *element, const char *name);
/// 1 if the element has that name.
int xml_is(const xml_element *element, const char *name);

#endif
