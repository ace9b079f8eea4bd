/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/flexure.h"
#include "base/constants.h"
#include "flexure/section.h"
#include <math.h>
#include <string.h>

/* a quantity that was never filled has no id */
static bool known(const fw_quantity *q) {
    return q->id && !q->unknown;
}

/* the material's criterion says that it fractures */
static bool brittle(const fw_device_material *material) {
    return material->criterion && strncmp(material->criterion, "fracture", 8) == 0;
}

static bool from_device(const fw_quantity *q) {
    return known(q) && q->source && strcmp(q->source, "device file") == 0;
}

/* from one quantity, as it is */
static void take_plain(const fw_quantity *q, const char *definition, fw_flexure_limit *limit) {
    limit->allowable_Pa = q->value;
    limit->status = q->status;
    limit->source = q->source ? q->source : "";
    limit->definition = definition;
}

static fw_quantity_value_status weakest(const fw_quantity *const *q, int n) {
    fw_quantity_value_status worst = FW_MEASURED;
    for (int i = 0; i < n; i++)
        if (q[i]->status > worst) worst = q[i]->status;
    return worst;
}

/* ---- the criteria ---- */

/* what the device file states of its own material */
static bool stated(const fw_flexure_limit_input *in, fw_flexure_limits *all,
                   fw_flexure_limit *limit) {
    (void)all;
    if (!in->material->strength_stated) return false;
    take_plain(&in->material->strength, "strength as the device file states it, which rules alone",
               limit);
    return true;
}

/* What breaks: its plain strength, or, where a failure probability P of the whole device is asked
   for, the stress at which one of its n flexures in series breaks with 1 - (1 - P)^(1/n) (what each may have of P where
   they are not strained alike is for the verdict to say):
     sigma = sigma0 ((A0/A_eff) ln(1/(1 - P))/n)^(1/m)
   A distribution that the device file states counts for what yields, too, beside its yield.
   source: Weibull (1951), docs/theory/limits-of-materials.md eq. 1-3; test_weibull.c */
static bool fracture(const fw_flexure_limit_input *in, fw_flexure_limits *all,
                     fw_flexure_limit *limit) {
    const fw_device_material *m = in->material;
    const fw_device_limit_data *d = &m->limit;
    if (!brittle(m) && !from_device(&d->weibull_strength)) return false;
    double probability = in->asked->failure_probability;
    bool asked = probability > 0;
    if (known(&d->weibull_strength) && known(&d->weibull_modulus) && known(&d->weibull_area))
        all->weibull = (fw_flexure_weibull){
            .known = true,
            .strength_Pa = d->weibull_strength.value,
            .modulus = d->weibull_modulus.value,
            .area_m2 = d->weibull_area.value,
            .effective_m2 = fw_flexure_weibull_area_m2(in->flexure, d->weibull_modulus.value)};
    if (asked && all->weibull.known) {
        const fw_quantity *const used[] = {&d->weibull_strength, &d->weibull_modulus,
                                           &d->weibull_area};
        limit->definition =
            "fracture at the failure probability asked for of the device, by what all of its "
            "flexures have of it (Weibull, with the stressed surface)";
        limit->source = d->weibull_strength.source;
        limit->status = weakest(used, 3);
        limit->allowable_Pa = fw_flexure_weibull_stress_Pa(
            &all->weibull, fw_flexure_series_share(probability, in->nhinge));
        return true;
    }
    if (!brittle(m)) return false;
    if (asked) {
        all->missing = "weibull-strength, weibull-modulus and weibull-area";
        all->missing_place = in->asked->probability_place;
    }
    if (!known(&m->strength)) return false;
    take_plain(&m->strength, "fracture strength of the material's data, without a probability",
               limit);
    return true;
}

/* 0.2 % offset of a film of thickness t: A + B (t/1 um)^-n, up to the thickness that the law was
   found for. in: Pa, Pa, 1, t m; out: Pa; source: Yu and Spaepen (2004) for copper on polymer;
   test_limits.c film_law */
static bool film(const fw_flexure_limit_input *in, fw_quantity *offset) {
    const fw_device_limit_data *d = &in->material->limit;
    const fw_quantity *const used[] = {&d->film_yield, &d->film_yield_rise, &d->film_exponent,
                                       &d->film_thickest};
    double t = in->flexure->depth_m;
    for (int i = 0; i < 4; i++)
        if (!known(used[i])) return false;
    if (!(t <= d->film_thickest.value)) return false;
    *offset = d->film_yield;
    offset->value += d->film_yield_rise.value * pow(t / 1e-6, -d->film_exponent.value);
    offset->status = weakest(used, 4);
    return true;
}

/* What yields, for position accuracy: the proportional limit. It is, in this order, factor x the
   0.2 % offset value that the device file states, or that the thickness law gives; the material's
   own strength, unless that is of fracture; factor x the material's 0.2 % offset. For survival: the
   0.2 % offset itself, and where only a strength is known that. */
static bool yielding(const fw_flexure_limit_input *in, fw_flexure_limits *all,
                     fw_flexure_limit *limit) {
    (void)all;
    const fw_device_material *m = in->material;
    const fw_device_limit_data *d = &m->limit;
    fw_quantity offset = d->offset_yield;
    bool own = from_device(&d->offset_yield), law = !own && film(in, &offset);
    bool have = known(&offset);
    bool strength = !brittle(m) && known(&m->strength);
    if (in->asked->survival && have) {
        take_plain(&offset,
                   law ? "0.2 % offset yield of a film this thick (survival only)"
                       : "0.2 % offset yield (survival only)",
                   limit);
        return true;
    }
    if (have && (own || law || !strength) && known(&d->proportional_factor)) {
        const fw_quantity *const used[] = {&offset, &d->proportional_factor};
        take_plain(&offset,
                   law ? "proportional limit, a share of the 0.2 % offset yield of a film this "
                         "thick"
                       : "proportional limit, a share of the 0.2 % offset yield",
                   limit);
        limit->allowable_Pa *= d->proportional_factor.value;
        limit->status = weakest(used, 2);
        return true;
    }
    if (!strength) return false;
    take_plain(&m->strength, "strength of the material's data, taken as proportional limit", limit);
    return true;
}

/* Strain life, counted as stress E eps_a, since what a turned strip imposes is a strain:
     E eps_a(N) = S (N/N1)^b + E eps_f' (2N)^c,   S = sigma1 - E eps_f' (2 N1)^c
   so that N1 cycles of sigma1 last exactly, whether or not the plastic part is known.
   in: Pa, cycles, 1; out: Pa, cycles. Valid 1 <= N, S > 0; error: that of the data, a factor of
   two in life is usual. Cost: two pow; the inverse some six of these.
   Source: O. H. Basquin, Proc. ASTM 10 (1910) 625; S. S. Manson, NACA TN 2933 (1953); L. F. Coffin,
   Trans. ASME 76 (1954) 931. Test: test_strain_life.c */

static double plastic_Pa(const fw_flexure_strain_life *law, double cycles) {
    if (!(law->ductility > 0)) return 0;
    return law->youngs_Pa * law->ductility * pow(2 * cycles, law->ductility_exponent);
}

/* elastic part of amplitude_Pa */
static double elastic_part_Pa(const fw_flexure_strain_life *law) {
    return law->amplitude_Pa - plastic_Pa(law, law->cycles);
}

double fw_flexure_strain_life_amplitude_Pa(const fw_flexure_strain_life *law, double cycles) {
    return elastic_part_Pa(law) * pow(cycles / law->cycles, law->exponent) +
           plastic_Pa(law, cycles);
}

/* Newton on logarithms: ln sigma(ln N) is convex and falls, so that from below the root in N it
   comes up to it without passing it */
double fw_flexure_strain_life_cycles(const fw_flexure_strain_life *law, double amplitude_Pa) {
    double s = fabs(amplitude_Pa), b = law->exponent, c = law->ductility_exponent;
    double elastic = elastic_part_Pa(law);
    if (!(s > 0)) return (double)INFINITY;
    double ln = log(law->cycles) + log(s / elastic) / b;
    if (!(law->ductility > 0)) return exp(ln);
    ln = fmax(ln, log(s / (law->youngs_Pa * law->ductility)) / c - log(2));
    for (int i = 0; i < 60; i++) {
        double e = elastic * exp(b * (ln - log(law->cycles)));
        double p = law->youngs_Pa * law->ductility * exp(c * (ln + log(2)));
        double step = log((e + p) / s) * (e + p) / (b * e + c * p);
        ln -= step;
        if (!(fabs(step) > 1e-13 * fmax(1, fabs(ln)))) break;
    }
    return exp(ln);
}

/* amplitude that lasts the cycles asked for, once per repetition; the law itself goes to the
   verdict, which counts the cycles of a motion. Data: flexure.h */
static bool fatigue_life(const fw_flexure_limit_input *in, fw_flexure_limits *all,
                         fw_flexure_limit *limit) {
    const fw_device_limit_data *d = &in->material->limit;
    if (!(in->asked->cycles > 0)) return false;
    const fw_quantity *const used[] = {&d->fatigue_strength, &d->fatigue_cycles,
                                       &d->fatigue_exponent, &d->ductility, &d->ductility_exponent};
    bool plastic = known(&d->ductility) && known(&d->ductility_exponent);
    all->life =
        (fw_flexure_strain_life){.known = true,
                                 .amplitude_Pa = d->fatigue_strength.value,
                                 .cycles = d->fatigue_cycles.value,
                                 .exponent = d->fatigue_exponent.value,
                                 .youngs_Pa = in->flexure->youngs_Pa,
                                 .ductility = plastic ? d->ductility.value : 0,
                                 .ductility_exponent = plastic ? d->ductility_exponent.value : 0};
    for (int i = 0; i < 3; i++)
        all->life.known = all->life.known && known(used[i]);
    if (!all->life.known) {
        all->missing = "fatigue-strength, fatigue-cycles and fatigue-exponent";
        all->missing_place = in->asked->cycles_place;
        return false;
    }
    if (!(elastic_part_Pa(&all->life) > 0)) {
        all->life.known = false;
        all->missing = "a ductility that leaves some of fatigue-strength elastic";
        all->missing_place = in->asked->cycles_place;
        return false;
    }
    limit->definition =
        plastic ? "amplitude at life (Basquin, Manson and Coffin)" : "amplitude at life (Basquin)";
    limit->source = d->fatigue_strength.source;
    limit->status = weakest(used, plastic ? 5 : 3);
    limit->allowable_Pa = fw_flexure_strain_life_amplitude_Pa(&all->life, in->asked->cycles);
    return true;
}

/* ---- all of them ---- */

static const fw_flexure_limit_row table[FW_LIMITS] = {
    {"strength", "the strength that the device file states, alone", stated},
    {"fracture", "the strength of what breaks: plain, or at a failure probability", fracture},
    {"yield", "the proportional limit of metals; for survival the 0.2 % offset", yielding},
    {"fatigue", "the amplitude that lasts a number of cycles", fatigue_life},
};

/* Material -> what it allows this flexure. A stated strength is the only static one.
   Cost: one pow per criterion. Test: test_limits.c the_lowest_governs, a_stated_strength_is_alone
 */
void fw_flexure_limits_of(const fw_flexure_limit_input *in, fw_flexure_limits *limits) {
    *limits = (fw_flexure_limits){.governing = FW_NONE, .fatigue = FW_NONE};
    for (size_t i = 0; i < FW_LIMITS; i++) {
        fw_flexure_limit found = {.criterion = table[i].name};
        bool fatigue = table[i].of == fatigue_life;
        if (limits->count > 0 && in->material->strength_stated && !fatigue) continue;
        if (!table[i].of(in, limits, &found)) continue;
        int k = limits->count++;
        limits->item[k] = found;
        if (fatigue)
            limits->fatigue = k;
        else if (limits->governing == FW_NONE ||
                 found.allowable_Pa < limits->item[limits->governing].allowable_Pa)
            limits->governing = k;
    }
}

const fw_flexure_limit *fw_flexure_limits_governing(const fw_flexure_limits *limits) {
    return limits->governing == FW_NONE ? NULL : &limits->item[limits->governing];
}

/* sigma_ar = sqrt(sigma_max sigma_a), sigma_max = sigma_a + |sigma_m|: a strip bends, so that one
   of its sides has the mean in tension, whichever its sign source: Smith, Watson, Topper, J.
   Materials 5 (1970) 767; test_strain_life.c mean_stress */
double fw_flexure_equivalent_amplitude_Pa(double amplitude_Pa, double mean_Pa) {
    return sqrt((amplitude_Pa + fabs(mean_Pa)) * amplitude_Pa);
}

/* Effective surface of a flexure under a pure moment, at the peak stress Kt sigma of its fillets:
     A_eff = (L h + L t/(m+1)) / Kt^m + 2 (pi/2 rho h + rho t/(m+1))
   first the strip: its side in tension, uniform, and both faces, across which the stress rises from
   the middle as y, so that int (2y/t)^m dy over the half in tension is t/2/(m+1) each; then the two
   fillets on that side, with a quarter turn of surface each and as much of the faces as they are
   long, all taken at the peak: that bounds their share from above. A flexure that turns as far to
   the other side stresses as much again.
   in: L, t, h, rho in m, m 1; out: m2; valid m > 0; error: of the allowable stress at most
   (1 + share of the fillets)^(1/m) too low, 3 % at m = 10, rho = t/2
   source: W. Weibull, J. Appl. Mech. 18 (1951) 293; docs/theory/limits-of-materials.md eq. 2;
   test_weibull.c area_against_numerical_integration */
double fw_flexure_weibull_area_m2(const fw_flexure_input *f, double m) {
    double t = f->width_m, h = f->depth_m, rho = fmax(f->fillet_m, 0.0);
    double kt = fw_flexure_fillet_concentration(t, f->fillet_m), faces = t / (m + 1.0);
    return f->length_m * (h + faces) * pow(kt, -m) + 2.0 * rho * (0.5 * FW_PI * h + faces);
}

/* P = 1 - exp(-(A_eff/A0) (sigma/sigma0)^m); in: Pa, tension or compression of the same size on the
   other side; out: 1; relative error of small P kept by expm1; test_weibull.c */
double fw_flexure_weibull_probability(const fw_flexure_weibull *w, double peak_Pa) {
    return -expm1(-w->effective_m2 / w->area_m2 * pow(fabs(peak_Pa) / w->strength_Pa, w->modulus));
}

double fw_flexure_weibull_stress_Pa(const fw_flexure_weibull *w, double probability) {
    double links = -log1p(-probability) * w->area_m2 / w->effective_m2;
    return w->strength_Pa * pow(links, 1.0 / w->modulus);
}

double fw_flexure_series_share(double probability, int n) {
    return -expm1(log1p(-probability) / (n > 0 ? n : 1));
}

double fw_flexure_series_probability(const double *probability, int n) {
    double survives = 0.0; /* its logarithm */
    for (int i = 0; i < n; i++)
        survives += log1p(-probability[i]);
    return -expm1(survives);
}
