/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the two kinds of flexures that are no pins share: closed form (hinge_element.c) and exact
   beam (hinge_exact.c). Private to the room. */
#ifndef FW_EFFECTS_HINGE_ELEMENT_H
#define FW_EFFECTS_HINGE_ELEMENT_H
#include "effects/effect.h"

typedef struct fw_effects_exact fw_effects_exact;

typedef struct fw_effects_flexed { /* data of an element; ports: pin on body a, pin on body b */
    fw_flexure_hinge_law law;
    double sense;               /* o: 1 where body a has the root at polar angle -a, else -1 */
    double axis_rad, free_rad;  /* axis less half of the drawn turns */
    double loss_s[2];           /* tau along and across the axis */
    double factor, varying;     /* U times factor + varying law(t): temperature */
    fw_flexure_hinge_rest rest; /* what does not depend on the rotation */
    fw_effects_exact *exact;    /* of hinge_exact.c; NULL: closed form */
} fw_effects_flexed;

static inline bool fw_effects_flexed_loses(const fw_effects_flexed *h) {
    return h->loss_s[0] > 0 || h->loss_s[1] > 0;
}
/* what U is multiplied by, and its rate */
double fw_effects_flexed_warmth(const fw_effects_force_element *e, const fw_effects_port_state *s,
                                double *rate);
extern const fw_effects_element_class fw_effects_flexed_class; /* hinge_element.c */
/* the closed form: elastic force times warm, and what the material dissipates; warm 0: that alone
 */
void fw_effects_flexed_force(const fw_effects_flexed *h, const fw_effects_port_state *s,
                             double warm, double *f);
void fw_effects_flexed_tangent(const fw_effects_flexed *h, const fw_effects_port_state *s,
                               double warm, double *stiffness, double *damping);
double fw_effects_flexed_loss_W(const fw_effects_flexed *h, const fw_effects_port_state *s);

/* hinge_exact.c */
bool fw_effects_exact_is_known(const fw_mechanism_hinge *hinge);
fw_status fw_effects_exact_new(fw_arena *arena, const fw_mechanism_hinge *hinge,
                               fw_effects_exact **out);
extern const fw_effects_element_class fw_effects_exact_class;
extern const double fw_effects_exact_tolerance; /* relative, of its forces */

/* How a choice of level enters the decision on effects. Private to the room. */

/* this effect is in or out because of the level asked for, whatever else is asked */
bool fw_effects_hinge_forced(const char *effect, fw_effects_hinge_model asked, bool *in);
const char *fw_effects_hinge_forced_reason(const fw_effect_choice *choice);
/* after everything was added: fills ledger->hinge, makes beams of closed forms where asked for */
fw_status fw_effects_hinge_settle(const fw_effect_case *c, const fw_effect_choice *choice,
                                  fw_effect_ledger *ledger, fw_effects_loads *loads);

#endif
