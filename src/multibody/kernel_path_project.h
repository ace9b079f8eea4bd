/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Second part of kernel_path.h: the projection of q and v, by the steps of kernel_core.h. */

static double residual(path *p, const double *u, double *relative) {
    real worst = {0};
    set_pose(p, u);
    for (int i = 0; i < p->records; i++)
        SIDES(s) {
            record *r = RECORD(p, i, s);
            bool middle = i == p->half;
            const record *o = mate(r, s);
            real ox = gather(r, u, 0), oy = gather(r, u, 1);
            real ix = middle ? cross(gather(o, u, 0)) : gather(NEXT(r), u, 0);
            real iy = middle ? cross(gather(o, u, 1)) : gather(NEXT(r), u, 1);
            r->x0 = r->offset_x + ox - ix + r->arm.rox - r->arm.rix;
            r->x1 = r->offset_y + oy - iy + r->arm.roy - r->arm.riy;
            worst = real_max(worst, r->x0 * r->x0 + r->x1 * r->x1);
        }
    *relative = sqrt(real_most(worst / (p->size * p->size)));
    return sqrt(real_most(worst));
}

static void move(path *p, double *to) {
    for (int i = p->first; i < p->bodies; i++)
        SIDES(s) {
            const record *r = RECORD(p, i, s);
            if (!writes(p, i, s)) continue;
            triple t = push_of(p, i, s);
            real x = gather(r, to, 0), y = gather(r, to, 1), phi = gather(r, to, 2);
            scatter(r, to, x + t.x, y + t.y, phi + t.phi);
        }
}

static bool project_position(path *p, double *u, double *norm) {
    double before = (double)INFINITY, relative = 0;
    bits broken;
    for (int i = 0; i < 20; i++) {
        *norm = residual(p, u, &relative);
        if (!(*norm < (double)INFINITY)) return false;
        bool slow = relative > 0.25 * before;
        if (relative <= 2 * DBL_EPSILON || (slow && relative <= 1e-13 && *norm <= 1e-12)) break;
        /* the loop's right-hand side leaves no factor of the blocks */
        if (slow || i == 4 || (i == 0 && p->loop)) {
            factor(p, &broken);
            if (bits_any(broken)) return false;
        }
        before = relative;
        solve(p);
        move(p, u);
    }
    return *norm <= 1e-12;
}

static bool project_velocity(path *p, double *v, double *norm) {
    double before = (double)INFINITY;
    real size = real_of(DBL_MIN);
    for (int i = p->first; i < p->bodies; i++)
        SIDES(s)
    for (int c = 0; c < 3; c++)
        size = real_max(size, real_abs(gather(RECORD(p, i, s), v, c)));
#if FW_SIDES == 1
    size = real_max(size, cross(size));
#endif
    for (int sweep = 0; sweep < 6; sweep++) {
        real worst = {0};
        for (int i = 0; i < p->records; i++)
            SIDES(s) {
                record *r = RECORD(p, i, s);
                bool middle = i == p->half;
                const record *o = mate(r, s);
                real ox = gather(r, v, 0), oy = gather(r, v, 1), ow = gather(r, v, 2);
                real ix = middle ? cross(gather(o, v, 0)) : gather(NEXT(r), v, 0);
                real iy = middle ? cross(gather(o, v, 1)) : gather(NEXT(r), v, 1);
                real iw = middle ? cross(gather(o, v, 2)) : gather(NEXT(r), v, 2);
                r->x0 = (ox - ow * r->arm.roy) - (ix - iw * r->arm.riy);
                r->x1 = (oy + ow * r->arm.rox) - (iy + iw * r->arm.rix);
                worst = real_max(worst, real_max(real_abs(r->x0), real_abs(r->x1)));
            }
        *norm = real_most(worst);
        double relative = real_most(worst / size);
        if (relative <= 2 * DBL_EPSILON || relative > 0.25 * before) break;
        before = relative;
        solve(p);
        move(p, v);
    }
    return *norm < (double)INFINITY;
}

static bool path_project(path *p, double *y, double *f) {
    double position, velocity, *v = y + p->nq * DESIGNS;
    bits broken, sick;
    if (!project_position(p, y, &position)) return false;
    sick = factor(p, &broken);
    if (bits_any(broken) || !project_velocity(p, v, &velocity)) return false;
    p->norms = (fw_kernel_norms){position, velocity};
    real power = set_accelerations(p, v);
    if (bits_any(sick)) {
        solve_by_sweeps(p, ~(bits){0});
    } else {
        set_rights(p);
        solve(p);
    }
    finish(p, broken, power, y, f);
    return true;
}
