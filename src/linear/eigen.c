// Eigenvalues of a symmetric 3x3 matrix by cyclic Jacobi rotations. Each rotation zeroes one off-diagonal entry; the
// sum of their squares falls quadratically, so a handful of sweeps reaches rounding. Eigenvectors stay orthogonal to
// rounding whatever the spread of the eigenvalues.
#include "linear/mat3.h"

// One rotation in the plane (p, q) of the matrix a; v collects the eigenvectors as rows.
static void rotate(double a[3][3], double v[3][3], int p, int q) {
    double apq = a[p][q];
    if (apq == 0) return;
    // The smaller root of t^2 + 2 theta t - 1: the rotation of at most 45 degrees.
    double theta = (a[q][q] - a[p][p]) / (2 * apq);
    double t = fabs(theta) > 1e150 ? 0.5 / theta : copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    a[p][p] -= t * apq;
    a[q][q] += t * apq;
    a[p][q] = a[q][p] = 0;
    int r = 3 - p - q;
    double arp = a[r][p], arq = a[r][q];
    a[r][p] = a[p][r] = c * arp - s * arq;
    a[r][q] = a[q][r] = s * arp + c * arq;
    for (int k = 0; k < 3; k++) {
        double vp = v[p][k], vq = v[q][k];
        v[p][k] = c * vp - s * vq;
        v[q][k] = s * vp + c * vq;
    }
}

static void swap_pair(double a[3][3], double v[3][3], int p, int q) {
    if (a[p][p] <= a[q][q]) return;
    double t = a[p][p];
    a[p][p] = a[q][q];
    a[q][q] = t;
    for (int k = 0; k < 3; k++) {
        t = v[p][k];
        v[p][k] = v[q][k];
        v[q][k] = t;
    }
}

eigen3 sym3_compute_eigen(sym3 s) {
    double a[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 30; sweep++) {
        double off = fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]);
        double diagonal = fabs(a[0][0]) + fabs(a[1][1]) + fabs(a[2][2]);
        if (off == 0 || diagonal + off == diagonal) break;
        rotate(a, v, 0, 1);
        rotate(a, v, 0, 2);
        rotate(a, v, 1, 2);
    }
    // Ascending, then a right-handed basis.
    swap_pair(a, v, 0, 1);
    swap_pair(a, v, 1, 2);
    swap_pair(a, v, 0, 1);
    eigen3 e = {{a[0][0], a[1][1], a[2][2]},
                {{v[0][0], v[0][1], v[0][2]}, {v[1][0], v[1][1], v[1][2]}, {v[2][0], v[2][1], v[2][2]}}};
    e.v.r2 = vec3_cross(e.v.r0, e.v.r1);
    return e;
}
