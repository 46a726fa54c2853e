// Which of the closed forms vertices are, and its measures.
#include "polytope/closed_form.h"

#include "linear/box.h"
#include "polytope/centered_box.h"
#include "polytope/sphere.h"

closed_form closed_form_find(const double *vertices, size_t count) {
    closed_form form = {.kind = FORM_NONE};
    if (centered_box_find(vertices, count, &form.half))
        form.kind = FORM_BOX;
    else if (regular_solid_find(vertices, count, &form.solid))
        form.kind = FORM_REGULAR;
    else if (ellipsoid_grid_find(vertices, count, &form.grid))
        form.kind = FORM_ELLIPSOID;
    return form;
}

ovoid_measures closed_form_compute_measures(const closed_form *form, const ovoid_polytope *p) {
    int is_box = form->kind == FORM_BOX;
    ovoid_measures m = is_box                         ? centered_box_compute_measures(form->half)
                       : form->kind == FORM_ELLIPSOID ? ellipsoid_grid_compute_measures(&form->grid)
                                                      : regular_solid_compute_measures(&form->solid, p->vertices);
    if (!is_box) m.box = box_make_around(p->vertices, p->vertex_count);
    m.sphere_radius = sphere_compute_radius(p->vertices, p->vertex_count, m.sphere_center);
    return m;
}
