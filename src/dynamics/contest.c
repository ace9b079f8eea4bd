/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which integrator, by trial. A choice by estimates (choose.c) may be wrong by much where what is
   fast is hardly excited, or comes up only on the way. The looser run is cheap: where one of the
   signs below says so it is made by the other integrator too, which may cost two fifths of the
   first one's steps, and takes over when it gets to the end with that.

     explicit, before: stability will hold its steps short, needed < stable/2, stable >= 200
     explicit, after:  it did, N < 2 stable and N >= 200, or something else did that nobody saw,
                       N > 5 max(needed, stable) and N >= 60
     implicit, after:  it took more than explicit steps should cost, max(needed, stable) < N price/2

   with N steps of the looser run, `needed` and `stable` explicit ones (choose.c), and the price of
   an implicit step in explicit ones. Two fifths, because the answer's tolerance, some ten times
   lower, lengthens implicit runs by 10^0.2 to 10^0.25, and those not whose steps stability keeps
   short.
   Cost: at most two fifths of the looser run, where it loses.
   Error: no answer changes but by the integrator. Statistics: docs/theory/integrators.md.
   Source: Hairer and Wanner II, IV.2 (detection of stiffness). Test: test_choose.c. */
#include "dynamics/steer.h"
#include <math.h>
#include <string.h>

static const double fw_share = 0.4;
static const long fw_many = 200, fw_some = 60;

static fw_contest implicit_one(const fw_run *r, double steps) {
    return (fw_contest){&fw_radau5_row, (long)(fw_share * steps / r->implicit_price)};
}

fw_contest fw_contest_of(const fw_run *r, long steps) {
    const fw_contest none = {NULL, 0};
    bool watched = r->options->unsettled || r->options->other || r->sudden;
    double explicit_ = fmax(r->needed, r->stable), n = (double)steps;
    if (watched || !(r->implicit_price > 0)) return none;
    if (r->integrator == &fw_radau5_row) {
        double paid = n * r->implicit_price;
        return explicit_ < 0.5 * paid ? (fw_contest){&fw_dop853_row, (long)(fw_share * paid)}
                                      : none;
    }
    if (steps == 0)
        return r->needed < 0.5 * r->stable && r->stable >= (double)fw_many
                   ? implicit_one(r, r->stable)
                   : none;
    bool held = steps >= fw_many && n < 2 * r->stable;
    bool unseen = steps >= fw_some && n > 5 * explicit_;
    return held || unseen ? implicit_one(r, n) : none;
}

fw_status fw_contest_won(fw_run *r, long before, long steps) {
    bool implicit = r->integrator == &fw_radau5_row;
    const char *names[2] = {"explicit", "implicit"};
    FW_NEED(r->motion->reason = fw_arena_printf(
                r->arena,
                "auto: tried, %s steps %s %ld, %s ones take %ld (an implicit one costs %.2g "
                "explicit ones)",
                names[!implicit], before > 0 ? "take" : "would take",
                before > 0 ? before : (long)r->stable, names[implicit], steps, r->implicit_price));
    r->motion->integrator = r->integrator->name;
    r->patience = r->implicit_price = 0; /* that is the last word */
    return FW_OK;
}
