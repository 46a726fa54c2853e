// A shape from points: the report of the given points, and the ellipsoids around and inside the hull.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

int main(void) {
    // A spiral on the unit sphere, a point inside, and one point twice.
    enum { COUNT = 200 };
    double points[3 * (COUNT + 2)];
    for (int i = 0; i < COUNT; i++) {
        double z = 2 * (i + 0.5) / COUNT - 1, r = sqrt(1 - z * z), angle = 2.399963229728653 * i;
        points[3 * i] = r * cos(angle);
        points[3 * i + 1] = r * sin(angle);
        points[3 * i + 2] = z;
    }
    for (int k = 0; k < 3; k++) points[3 * COUNT + k] = 0.1, points[3 * COUNT + 3 + k] = points[k];

    ovoid_error error;
    ovoid_shape *shape = ovoid_shape_create_from_points(points, COUNT + 2, NULL, &error);
    if (!shape) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    ovoid_report report = ovoid_shape_get_report(shape);
    printf("%llu points: %llu vertices, %llu inside, %llu twice\n", (unsigned long long)report.points,
           (unsigned long long)report.vertices, (unsigned long long)report.interior,
           (unsigned long long)report.duplicates);

    double volume = ovoid_shape_get_measures(shape).volume;
    ovoid_fit outer = ovoid_shape_get_outer(shape), inner = ovoid_shape_get_inner(shape);
    printf("volumes: inner ellipsoid %g, body %g, outer ellipsoid %g\n", inner.volume, volume, outer.volume);
    int right = report.vertices == COUNT && report.interior == 1 && report.duplicates == 1 && inner.volume <= volume &&
                volume <= outer.volume;
    ovoid_shape_destroy(shape);
    return right ? 0 : 1;
}
