// The choice of the plane that cuts a piece. Planes across the axes are tried at even steps, as in V-HACD and CoACD (K.
// Mamou, F. Ghorbel, A simple and efficient approach for 3D mesh approximate convex decomposition, 2009; X. Wei, M.
// Liu, Z. Ling, H. Su, Approximate convex decomposition for 3D meshes with collision-aware concavity and tree search,
// 2022), and also planes through the outliers, and planes of the faces near to those: only a cut flush with a face
// divides an angle into boxes.
//
// The cost of a plane is the sum of the squared distances of the outliers that remain in the hull of either side. The
// hulls are approximated from outside by their supports along 134 directions.
#include "decompose/piece.h"

#include <string.h>

enum { ROUND = 128, DIRECTIONS = ROUND + 6, CORNERS = 6144, STEPS = 11, FARTHEST = 8 };

typedef struct supports {
    const ovoid_plane *plane;
    float h[2][DIRECTIONS];
} supports;

typedef struct choice {
    const body *b;
    const piece *p;
    float directions[3][DIRECTIONS];
    box around;
    double best;
    ovoid_plane plane;
    vec3 frame_middle;
    ovoid_polytope frame;
    uint8_t frame_inside[1024];
} choice;

// Directions evenly over the sphere (a spiral of golden angles), and the axes.
static void set_directions(choice *c) {
    for (int i = 0; i < ROUND; i++) {
        double z = 1 - (2 * i + 1.0) / ROUND, r = sqrt(1 - z * z), a = 2.399963229728653 * i;
        c->directions[0][i] = (float)(r * cos(a));
        c->directions[1][i] = (float)(r * sin(a));
        c->directions[2][i] = (float)z;
    }
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) c->directions[k][ROUND + i] = i / 2 == k ? (i % 2 ? -1.0F : 1.0F) : 0.0F;
}

static void add_support(const choice *c, float h[DIRECTIONS], vec3 x) {
    float px = (float)x.x, py = (float)x.y, pz = (float)x.z;
    for (int i = 0; i < DIRECTIONS; i++) {
        float d = c->directions[0][i] * px + c->directions[1][i] * py + c->directions[2][i] * pz;
        h[i] = d > h[i] ? d : h[i];
    }
}

static int is_within(const choice *c, const float h[DIRECTIONS], vec3 x) {
    float px = (float)x.x, py = (float)x.y, pz = (float)x.z;
    for (int i = 0; i < DIRECTIONS; i++)
        if (c->directions[0][i] * px + c->directions[1][i] * py + c->directions[2][i] * pz > h[i]) return 0;
    return 1;
}

// Adds a point of the piece to its side, or to both.
static void add_point(const choice *c, supports *s, double margin, vec3 x) {
    const ovoid_plane *plane = s->plane;
    double d = vec3_dot(plane->normal, x) - plane->offset;
    if (d <= margin) add_support(c, s->h[0], x);
    if (d >= -margin) add_support(c, s->h[1], x);
}

static vec3 cross(vec3 a, vec3 b, const ovoid_plane *plane) {
    double da = vec3_dot(plane->normal, a) - plane->offset, db = vec3_dot(plane->normal, b) - plane->offset;
    return vec3_add_scaled(a, vec3_sub(b, a), da / (da - db));
}

static void add_triangle(const choice *c, supports *s, double margin, const vec3 t[3]) {
    const ovoid_plane *plane = s->plane;
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = vec3_dot(plane->normal, t[k]) - plane->offset;
    for (int side = 0; side < 2; side++) {
        double sign = side ? 1 : -1, most = sign * d[0];
        for (int k = 1; k < 3; k++) most = max2(most, sign * d[k]);
        if (most <= margin) continue;
        for (int k = 0; k < 3; k++) {
            int j = (k + 1) % 3;
            if (sign * d[k] >= -margin) add_support(c, s->h[side], t[k]);
            if ((d[k] > margin && d[j] < -margin) || (d[k] < -margin && d[j] > margin))
                add_support(c, s->h[side], cross(t[k], t[j], plane));
        }
    }
}

// Adds the points that belong to the cell: its corners inside the solid, and the points where the plane cuts its edges
// inside.
static void add_frame(const choice *c, supports *s) {
    const ovoid_plane *plane = s->plane;
    const ovoid_polytope *f = &c->frame;
    for (uint32_t i = 0; i < f->vertex_count; i++) {
        vec3 x = piece_get_frame_point(c->b, f, i);
        double d = vec3_dot(plane->normal, x) - plane->offset;
        if (i >= sizeof c->frame_inside || c->frame_inside[i]) add_support(c, s->h[d > 0], x);
        for (uint32_t k = f->neighbor_starts[i]; k < f->neighbor_starts[i + 1]; k++) {
            if (f->neighbors[k] < i) continue;
            vec3 y = piece_get_frame_point(c->b, f, f->neighbors[k]);
            if ((vec3_dot(plane->normal, y) > plane->offset) == (d > 0)) continue;
            vec3 at = cross(x, y, plane);
            if (piece_is_inside(c->b, at, c->frame_middle)) add_point(c, s, INFINITY, at);
        }
    }
}

static double compute_cost(const choice *c, const ovoid_plane *plane) {
    supports s;
    s.plane = plane;
    for (int i = 0; i < DIRECTIONS; i++) s.h[0][i] = s.h[1][i] = -INFINITY;
    double margin = 1e-9 * c->b->diagonal;
    const soup *all = &c->p->triangles;
    size_t step = all->count / 3 / (CORNERS / 3) + 1;
    for (size_t t = 0; t < all->count / 3; t += step) add_triangle(c, &s, margin, all->corners + 3 * t);
    add_frame(c, &s);
    if (s.h[0][0] == -INFINITY || s.h[1][0] == -INFINITY) return INFINITY;
    double cost = 0;
    for (uint32_t i = 0; i < c->p->outlier_count; i++) {
        const outlier *o = &c->p->outliers[i];
        if (is_within(c, s.h[0], o->point) || is_within(c, s.h[1], o->point)) cost += o->distance * o->distance;
    }
    return cost;
}

// Planes far from the middle cost slightly more, so that of equal planes the even one is chosen.
static void try_plane(choice *c, vec3 normal, double offset) {
    ovoid_plane plane = {normal, offset};
    double first = c->p->outliers[0].distance,
           away = vec3_dot(normal, vec3_scale(vec3_add(c->around.min, c->around.max), 0.5));
    double size = vec3_norm(vec3_sub(c->around.max, c->around.min));
    double cost = compute_cost(c, &plane) + 0.5 * first * first * fabs(offset - away) / size;
    if (cost < c->best) c->best = cost, c->plane = plane;
}

static void try_axes(choice *c) {
    const double low[3] = {c->around.min.x, c->around.min.y, c->around.min.z};
    const double high[3] = {c->around.max.x, c->around.max.y, c->around.max.z};
    for (int k = 0; k < 3; k++)
        for (int i = 1; i <= STEPS; i++) {
            vec3 n = {k == 0, k == 1, k == 2};
            try_plane(c, n, low[k] + (high[k] - low[k]) * i / (STEPS + 1));
        }
}

// Chooses outliers far from one another, by even steps down the list, and tries planes through them and those of the
// faces near them.
static void try_outliers(choice *c) {
    uint32_t step = c->p->outlier_count / FARTHEST + 1;
    for (uint32_t i = 0; i < c->p->outlier_count; i += step) {
        const outlier *o = &c->p->outliers[i];
        vec3 t[3];
        body_get_triangle(c->b, o->triangle, t);
        vec3 n = vec3_unit(vec3_cross(vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0])));
        vec3 near = triangle_find_nearest(t, o->point), away = vec3_unit(vec3_sub(o->point, near));
        if (vec3_norm_squared(n) > 0) try_plane(c, n, vec3_dot(n, t[0]));
        for (int k = 0; k < 3; k++) {
            vec3 axis = {k == 0, k == 1, k == 2};
            try_plane(c, axis, vec3_dot(axis, near));
            // A plane through the point and the nearest one, which halves a wedge.
            vec3 across = vec3_cross(away, axis);
            if (vec3_norm_squared(across) > 1e-6) try_plane(c, vec3_unit(across), vec3_dot(vec3_unit(across), near));
        }
    }
}

// Tries planes ever nearer to the best one.
static void refine(choice *c) {
    double step = vec3_norm(vec3_sub(c->around.max, c->around.min)) / (2 * STEPS);
    for (int round = 0; round < 4; round++, step *= 0.5) {
        ovoid_plane at = c->plane;
        try_plane(c, at.normal, at.offset - step);
        try_plane(c, at.normal, at.offset + step);
    }
}

static void open_choice(choice *c, const body *b, const piece *p) {
    memset(c, 0, sizeof *c);
    c->b = b;
    c->p = p;
    c->best = INFINITY;
    c->frame = ovoid_shape_get_polytope(p->frame);
    c->frame_middle = piece_get_frame_middle(b, &c->frame);
    for (uint32_t i = 0; i < c->frame.vertex_count && i < sizeof c->frame_inside; i++)
        c->frame_inside[i] = (uint8_t)piece_is_inside(b, piece_get_frame_point(b, &c->frame, i), c->frame_middle);
    set_directions(c);
    c->around = box_make_around(&p->points[0].x, p->point_count);
}

double piece_find_plane(const body *b, const piece *p, ovoid_plane *plane) {
    if (!p->outlier_count) return INFINITY;
    choice c;
    open_choice(&c, b, p);
    try_axes(&c);
    try_outliers(&c);
    refine(&c);
    *plane = c.plane;
    return c.best;
}

double piece_compute_cost(const piece *p) {
    double cost = 0;
    for (uint32_t i = 0; i < p->outlier_count; i++) cost += p->outliers[i].distance * p->outliers[i].distance;
    return cost;
}

uint32_t piece_list_planes(const body *b, const piece *p, ovoid_plane planes[PIECE_PLANES]) {
    uint32_t count = 0, outliers = p->outlier_count < 3 ? p->outlier_count : 3;
    box around = box_make_around(&p->points[0].x, p->point_count);
    vec3 middle = vec3_scale(vec3_add(around.min, around.max), 0.5);
    for (int k = 0; k < 3; k++) {
        vec3 axis = {k == 0, k == 1, k == 2};
        planes[count++] = (ovoid_plane){axis, vec3_dot(axis, middle)};
    }
    for (uint32_t i = 0; i < outliers; i++) {
        const outlier *o = &p->outliers[i * (p->outlier_count / outliers)];
        vec3 t[3];
        body_get_triangle(b, o->triangle, t);
        vec3 n = vec3_unit(vec3_cross(vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0]))), near;
        if (vec3_norm_squared(n) > 0) planes[count++] = (ovoid_plane){n, vec3_dot(n, t[0])};
        near = triangle_find_nearest(t, o->point);
        for (int k = 0; k < 3; k++) {
            vec3 axis = {k == 0, k == 1, k == 2};
            planes[count++] = (ovoid_plane){axis, vec3_dot(axis, near)};
        }
    }
    return count;
}
