// Attributes that have no effect, misspelt ones for example: a limit with "uper" would else be 0 without a word. Those
// of the elements that are read are held against what can be read of them; elements that are not read are counted as
// such.
#include "robot/read/urdf/reader.h"

#include <string.h>

static const struct {
    const char *element, *known;
} elements[] = {
    {"robot", "name|version"},
    {"link", "name"},
    {"joint", "name|type|value"},
    {"origin", "xyz|rpy|quat_xyzw"},
    {"parent", "link"},
    {"child", "link"},
    {"axis", "xyz"},
    {"limit", "lower|upper|velocity|effort"},
    {"mimic", "joint|multiplier|offset"},
    {"collision", "name"},
    {"geometry", ""},
    {"box", "size"},
    {"sphere", "radius|center"},
    {"capsule", "radius|length"},
    {"cylinder", "radius|length"},
    {"mesh", "filename|scale"},
    {"group", "name"},
    {"chain", "base_link|tip_link"},
    {"group_state", "name|group"},
    {"disable_collisions", "link1|link2|reason"},
    {"virtual_joint", "name|type|parent_frame|child_link"},
    {"passive_joint", "name"},
    {"link_sphere_approximation", "link"},
};

/// What can be read of an element; NULL: it is not read.
static const char *find_known(const xml_element *element) {
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++)
        if (xml_is(element, elements[i].element)) return elements[i].known;
    return NULL;
}

ovoid_code robot_ignore_attributes(robot_reader *r, const xml_element *element) {
    const char *known = find_known(element);
    if (!known) return OVOID_OK;
    for (const xml_attribute *a = element->attributes; a; a = a->next) {
        if (robot_is_among(a->name, known) || strncmp(a->name, "xmlns", 5) == 0) continue;
        ovoid_code code = robot_ignore(r, element->name, "@", a->name);
        if (code) return code;
    }
    // The recursion is at most XML_DEPTH_MAX deep.
    for (const xml_element *e = element->first; e; e = e->next) {
        ovoid_code code = robot_ignore_attributes(r, e);
        if (code) return code;
    }
    return OVOID_OK;
}
