/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What rides on the six-bar without being of it, in a pose of the platform. A tree of bodies hangs on
   one of the six-bar's bodies (or on the ground); a joint that held two of these together would take
   freedom from the platform, and nothing could be required of it (workspace/inverse.c). Joined by
   welds and flexures that nothing else deflects it goes with that body as it is drawn: a required
   pose has no loads of its own, and flexures at rest stay as they are. A pin without a flexure, a
   slider, a rod, a driver, or a spring to something that moves against it leaves its pose open.
   In: mechanism; out: of every body the one it goes with. Cost: bodies times joints.
   Test: tests/clearance/cases.py riders */
#include "clearance/clearance_pair.h"
#include "workspace/workspace.h"

enum { LINKS = 5 };

static bool is_flexure(const fw_mechanism *m, int pin) {
    for (int i = 0; i < m->nhinge; i++)
        if (m->hinge[i].pin == pin) return true;
    return false;
}

/* what one of two joined bodies goes with the other goes with, too; true: that is new */
static bool spread(int a, int b, bool rigid, int *with) {
    int known = a == FW_GROUND ? FW_GROUND : with[a], other = b == FW_GROUND ? FW_GROUND : with[b];
    bool from_a = b >= LINKS && other == FW_CLEARANCE_NOT_SEEN && known != FW_CLEARANCE_NOT_SEEN;
    bool from_b = a >= LINKS && known == FW_CLEARANCE_NOT_SEEN && other != FW_CLEARANCE_NOT_SEEN;
    if (from_a) with[b] = rigid ? known : FW_CLEARANCE_OPEN;
    if (from_b) with[a] = rigid ? other : FW_CLEARANCE_OPEN;
    if (from_a || from_b) return true;
    /* a second joint that is not rigid, or one to what is open, opens the other */
    bool open = !rigid || known == FW_CLEARANCE_OPEN || other == FW_CLEARANCE_OPEN;
    bool more = false;
    if (open && a >= LINKS && known >= FW_GROUND) with[a] = FW_CLEARANCE_OPEN, more = true;
    if (open && b >= LINKS && other >= FW_GROUND) with[b] = FW_CLEARANCE_OPEN, more = true;
    return more;
}

static bool spring_pulls(const fw_mechanism *m, const int *with, int spring) {
    int a = m->spring[spring].body_a, b = m->spring[spring].body_b;
    int p = a == FW_GROUND ? FW_GROUND : with[a], q = b == FW_GROUND ? FW_GROUND : with[b];
    return p != q && (a >= LINKS || b >= LINKS);
}

void fw_clearance_riders(const fw_mechanism *m, int *with) {
    for (int i = 0; i < m->nbody; i++)
        with[i] = i < LINKS ? i : FW_CLEARANCE_NOT_SEEN;
    bool more = true;
    while (more) {
        more = false;
        for (int i = FW_SIX; i < m->npin; i++)
            more |= spread(m->pin[i].body_a, m->pin[i].body_b, is_flexure(m, i), with);
        for (int i = 0; i < m->njoint; i++)
            more |= spread(m->joint[i].body_a, m->joint[i].body_b,
                           m->joint[i].kind == FW_JOINT_WELD, with);
        for (int i = 0; i < m->nspring && !more; i++)
            if (spring_pulls(m, with, i))
                more |= spread(m->spring[i].body_a, m->spring[i].body_b, false, with);
        for (int i = 0; i < m->ndriver && !more; i++) {
            int pin = m->driver[i].revolute;
            if (pin >= FW_SIX) more |= spread(m->pin[pin].body_a, m->pin[pin].body_b, false, with);
        }
    }
    for (int i = LINKS; i < m->nbody; i++)
        if (with[i] == FW_CLEARANCE_NOT_SEEN) with[i] = FW_CLEARANCE_OPEN;
}
