/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room. A mechanism as a figure: what stands for bodies that nobody has drawn, and
   for joints, guides, rods, springs and drivers. The same parts serve still and moving pictures. */
#ifndef FW_REPORT_FIGURE_H
#define FW_REPORT_FIGURE_H
#include "report/report_page.h"

/* in the order in which they are drawn */
typedef enum fw_report_figure_role {
    FW_FIGURE_RAIL,  /* line on which a slider runs */
    FW_FIGURE_BODY,  /* outline or line through the joints and the centre of mass */
    FW_FIGURE_PLATE, /* a body with all joints in its centre of mass */
    FW_FIGURE_ROD,
    FW_FIGURE_DRIVEN_ROD,
    FW_FIGURE_SPRING, /* zigzag */
    FW_FIGURE_CABLE,  /* dashed */
    FW_FIGURE_BLOCK,  /* slider */
    FW_FIGURE_FOOT,   /* where something is held by the ground */
    FW_FIGURE_WELD,
    FW_FIGURE_STOP, /* the angles that body b has free */
    FW_FIGURE_TURN, /* driver of an angle */
    FW_FIGURE_PUSH, /* driver of a travel */
    FW_FIGURE_END,  /* of a rod or a spring */
    FW_FIGURE_PIN
} fw_report_figure_role;

typedef struct fw_report_figure_point { /* local to the body; ground: world */
    int body;
    double x_m, y_m;
} fw_report_figure_point;

typedef struct fw_report_figure_part {
    fw_report_figure_role role;
    int of;                        /* body that it stands for; FW_NONE */
    int pin;                       /* FW_NONE: not of a pin */
    fw_report_figure_point end[2]; /* lines: both ends; marks: [0] is their place */
    fw_geometry_vec2 *outline;     /* (noutline) BODY: in its frame, m, convex */
    int noutline;
    int turns_with;          /* marks: body; FW_GROUND: they do not turn */
    double angle_rad;        /* marks: in the frame of that body */
    double from_rad, to_rad; /* STOP: likewise; NaN: none on this side */
} fw_report_figure_part;

typedef struct fw_report_drawing_figure {
    const fw_mechanism *mechanism;
    double size_m;               /* larger extent of everything over all poses */
    fw_report_figure_part *part; /* (count) in the order of drawing */
    int count;
} fw_report_drawing_figure;

/* the parts. Guides are as long as the sliders go in the `count` poses q (count x 3 nbody). */
fw_status fw_report_figure_make(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                int count, fw_report_drawing_figure *figure);
/* the figure of the first variant's mechanism in its drawn pose *q (3 nbody), which is set to NULL
   where `verdict` has none (or is NULL) */
fw_status fw_report_figure_of_verdict(fw_arena *arena, const fw_verdict *verdict,
                                      fw_report_drawing_figure *figure, double **q);
fw_status fw_report_figure_rest_reach(fw_arena *arena, const fw_verdict *verdict,
                                      fw_geometry_box *box);
/* adds where a part gets to */
bool fw_report_figure_is_line(const fw_report_figure_part *part);
void fw_report_figure_reach(fw_geometry_box *box, const fw_report_figure_part *part,
                            const double *q, int count, int nbody);
/* a view of the box with room for marks around it, in a picture of `width` pixels */
fw_report_view fw_report_figure_view(const fw_geometry_box *box, double width);
fw_geometry_vec2 fw_report_figure_place(const double *q, fw_report_figure_point point);

/* ---- figure_svg.c ---- */
typedef struct fw_report_figure_pen {
    const fw_report_view *view;
    fw_text *out;
    const double *still; /* (3 nbody) pose shown; where it moves: to viewers that do not animate */
    const double *frame; /* (frames x 3 nbody) */
    int nbody, frames, seconds; /* 0 frames: a still picture */
    double mark;                /* pixels: size of marks */
} fw_report_figure_pen;
void fw_report_figure_draw(const fw_report_figure_part *part, const fw_report_figure_pen *pen);
/* the path data of the line or outline of a part at `q` */
void fw_report_figure_path(const fw_report_figure_part *part, const fw_report_figure_pen *pen,
                           const double *q);
/* the line or outline of a body, dashed, where `q` has it; nothing for other parts */
void fw_report_figure_ghost(const fw_report_figure_part *part, const double *q,
                            const fw_report_figure_pen *pen);
const char *fw_report_figure_colour(int body);
/* numbers that a part needs per frame */
int fw_report_figure_numbers(const fw_report_figure_part *part);
#endif
