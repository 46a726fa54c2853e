// Q = E E' by Cholesky with diagonal pivots.
#include "ellipsoid/distance/root.h"

#include "linear/exact.h"

root3 root3_make(sym3 q, int is_exact) {
    root3 e = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    dd m[3][3] = {{dd_from(q.xx), dd_from(q.xy), dd_from(q.xz)},
                  {dd_from(q.xy), dd_from(q.yy), dd_from(q.yz)},
                  {dd_from(q.xz), dd_from(q.yz), dd_from(q.zz)}};
    int is_diagonal = q.xy == 0 && q.xz == 0 && q.yz == 0;
    double least = is_diagonal ? 0 : (is_exact ? 0x1p-95 : 0x1p-51) * sym3_trace(q);
    for (int k = 0; k < 3; k++) {
        int p = m[0][0].high >= m[1][1].high ? 0 : 1;
        if (m[2][2].high > m[p][p].high) p = 2;
        double pivot = m[p][p].high, root = sqrt(fmax(pivot, 0));
        if (!(pivot > least)) break;
        e.axis[k] = (vec3){m[p][0].high / root, m[p][1].high / root, m[p][2].high / root};
        dd row[3] = {m[p][0], m[p][1], m[p][2]};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                if (i == p || j == p)
                    m[i][j] = dd_from(0);
                else if (is_exact)
                    m[i][j] = dd_sub(m[i][j], dd_div(dd_mul(row[i], row[j]), row[p]));
                else
                    m[i][j].high -= row[i].high * row[j].high / pivot;
            }
    }
    return e;
}
