/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What lateral etching does to a flexure, and how fine a mould can be printed. */
#ifndef FW_PROCESS_UNDERCUT_H
#define FW_PROCESS_UNDERCUT_H

/* widths at the top and the bottom of a beam after an etch that lasts T = depth_equivalent/R */
void fw_process_undercut_widths(double width_m, double anisotropy, double depth_m, double etched_m,
                                double *top_m, double *bottom_m);
/* k/k0 of a trapezoidal section against a rectangle of width w0, bending in the wafer plane */
double fw_process_undercut_stiffness(double top_m, double bottom_m, double w0_m);
/* anisotropy at which the top edge of a beam is just cut through */
double fw_process_undercut_cut(double width_m, double etched_m);
/* smallest anisotropy that keeps k/k0 >= 1 - tolerance; straight: full undercut over the depth */
double fw_process_undercut_needed(double width_m, double depth_m, double etched_m, double tolerance,
                                  int straight);
/* smallest line or space, contact or proximity printing */
double fw_process_print_limit(double wavelength_m, double gap_m, double resist_m);

#endif
