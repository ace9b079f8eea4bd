/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/results.h"
#include "base/constants.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

/* one number in columns [from, to) of a line of n bytes; Fortran writes "0.1-100" for exponents
   beyond two digits: that is 0 here */
static bool number_in(const char *line, size_t n, size_t from, size_t to, double *value) {
    if (to > n) to = n;
    while (from < to && line[from] == ' ')
        from++;
    while (to > from && line[to - 1] == ' ')
        to--;
    if (from >= to) return false;
    if (fw_number_parse(line + from, to - from, value)) return true;
    *value = 0.0;
    for (size_t i = from + 1; i < to; i++)
        if (line[i] == '-' && line[i - 1] >= '0' && line[i - 1] <= '9') return true;
    return false;
}

/* words separated by blanks; how many were numbers */
static int numbers_in(const char *line, size_t n, double *value, int most) {
    int count = 0;
    for (size_t i = 0; i < n && count < most;) {
        while (i < n && line[i] == ' ')
            i++;
        size_t from = i;
        while (i < n && line[i] != ' ')
            i++;
        if (i > from && !number_in(line, n, from, i, &value[count++])) return -1;
    }
    return count;
}

/* which step ends at this time; -1: none */
static int step_of(double time, int nstep) {
    double whole = floor(time + 0.5);
    return fabs(time - whole) < 1e-6 && whole >= 1.0 && whole <= nstep ? (int)whole - 1 : -1;
}

static bool starts(const char *line, size_t n, const char *with) {
    size_t k = strlen(with);
    return n >= k && memcmp(line, with, k) == 0;
}

fw_status fw_continuum_results_print(const char *text, const int *node, int nnode,
                                     fw_continuum_result_step *step, int nstep) {
    int now = -1;
    bool forces = false;
    for (const char *line = text; *line;) {
        size_t n = strcspn(line, "\n");
        double value[4];
        if (starts(line, n, " displacements") || starts(line, n, " forces")) {
            size_t at = n;
            while (at > 0 && line[at - 1] != ' ')
                at--;
            if (!number_in(line, n, at, n, &value[0])) return FW_SOLVER;
            now = step_of(value[0], nstep);
            forces = line[1] == 'f';
        } else if (n > 0 && now >= 0) {
            if (numbers_in(line, n, value, 4) != 4) return FW_SOLVER;
            for (int i = 0; i < nnode; i++) {
                if (node[i] != (int)value[0]) continue;
                double *to = forces ? step[now].force[i] : step[now].move[i];
                memcpy(to, value + 1, 3 * sizeof *to);
                *(forces ? &step[now].have_force[i] : &step[now].have_move[i]) = true;
            }
        }
        line += n + (line[n] == '\n');
    }
    return FW_OK;
}

/* Trigonometric solution of the characteristic cubic (O. K. Smith, Comm. ACM 4 (1961) 168): with
   m = tr/3, B = A - m I, p^2 = tr(B B)/6, q = det(B)/2: values m + 2 p cos(phi + 2 k pi/3),
   phi = acos(q/p^3)/3. Error some 1e-15 of the largest; test_external.c: against rotations */
void fw_continuum_results_principal(const double a[6], double value[3]) {
    double m = (a[0] + a[1] + a[2]) / 3.0, x = a[0] - m, y = a[1] - m, z = a[2] - m;
    double off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
    double p = sqrt((x * x + y * y + z * z + 2.0 * off) / 6.0);
    double det = x * (y * z - a[4] * a[4]) - a[3] * (a[3] * z - a[4] * a[5]) +
                 a[5] * (a[3] * a[4] - y * a[5]);
    double r = p > 0.0 ? 0.5 * det / (p * p * p) : 0.0;
    double phi = acos(fmax(-1.0, fmin(1.0, r))) / 3.0;
    value[2] = m + 2.0 * p * cos(phi);
    value[0] = m + 2.0 * p * cos(phi + 2.0 * FW_PI / 3.0);
    value[1] = 3.0 * m - value[0] - value[2];
}

static void add_to_peak(fw_continuum_result_peak *peak, int node, const double tensor[6]) {
    double v[3];
    fw_continuum_results_principal(tensor, v);
    double a = v[1] - v[0], b = v[2] - v[1], c = v[2] - v[0];
    peak->mises = fmax(peak->mises, sqrt(0.5 * (a * a + b * b + c * c)));
    double most = fmax(fabs(v[0]), fabs(v[2]));
    if (!(most > peak->principal)) return;
    peak->principal = most;
    peak->node = node;
}

/* Blocks of the ASCII format: "  100CL" with the time in columns 13-24, " -4" with the name, " -1"
   records of a node in columns 4-13 and values of 12 columns each, " -3" at the end (cgx manual,
   section 11) */
fw_status fw_continuum_results_fields(const char *text, fw_continuum_result_peak *strain,
                                      fw_continuum_result_peak *stress, int nstep, int *nfound) {
    fw_continuum_result_peak *into = NULL;
    int now = -1;
    *nfound = 0;
    for (const char *line = text; *line;) {
        size_t n = strcspn(line, "\n");
        double value[7];
        if (starts(line, n, "  100CL")) {
            if (!number_in(line, n, 12, 24, &value[0])) return FW_SOLVER;
            now = step_of(value[0], nstep);
        } else if (starts(line, n, " -4") && now >= 0) {
            bool is_strain = starts(line, n, " -4  TOSTRAIN");
            into = is_strain ? &strain[now] : starts(line, n, " -4  STRESS ") ? &stress[now] : NULL;
            if (into) *into = (fw_continuum_result_peak){0};
            if (is_strain) *nfound = now + 1;
        } else if (starts(line, n, " -3")) {
            into = NULL;
        } else if (into && starts(line, n, " -1")) {
            if (!number_in(line, n, 3, 13, &value[6])) return FW_SOLVER;
            for (size_t i = 0; i < 6; i++)
                if (!number_in(line, n, 13 + 12 * i, 25 + 12 * i, &value[i])) return FW_SOLVER;
            add_to_peak(into, (int)value[6], value);
        }
        line += n + (line[n] == '\n');
    }
    return FW_OK;
}
