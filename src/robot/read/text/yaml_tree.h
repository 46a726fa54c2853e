// A YAML file as a tree of values with their lines: one document, without aliases.
#ifndef OVOID_ROBOT_READ_TEXT_YAML_TREE_H
#define OVOID_ROBOT_READ_TEXT_YAML_TREE_H

#include "robot/read/text/pool.h"

/// Most bytes of a file, and how deep its values are nested at most.
#define YAML_SIZE_MAX ((size_t)1 << 26)
#define YAML_DEPTH_MAX 64

typedef enum yaml_kind { YAML_TEXT, YAML_LIST, YAML_MAP } yaml_kind;

typedef struct yaml_value {
    yaml_kind kind;
    int64_t line;
    const char *key;  ///< of a member of a map; NULL else
    const char *text; ///< of a YAML_TEXT; "" else
    size_t count;     ///< of items or members
    struct yaml_value *parent, *first, *last, *next;
} yaml_value;

/// Reads the file ("-": standard input); all of the tree is in the pool. An empty file is a map without members.
ovoid_code yaml_read(const char *path, pool *memory, yaml_value **root, ovoid_error *error);
/// Makes the value the last item or member of its parent.
void yaml_append(yaml_value *parent, yaml_value *value);

#endif
