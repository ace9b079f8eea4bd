/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside the report room: colours, drawing in picture coordinates, what pictures mark, the summary, sections
   of the page. */
#ifndef FW_REPORT_REPORT_PAGE_H
#define FW_REPORT_REPORT_PAGE_H
#include "base/svg.h"
#include "report/report.h"
#include "statics/statics.h"

/* ---- drawing.c: colours; Okabe and Ito's, which colour-blind readers tell apart ---- */
const char *fw_report_utilisation_colour(double utilisation);
const char *fw_report_decision_colour(fw_verdict_decision decision);
/* "REJECTED: " in front of the titles of files that may travel alone, else ""; NULL allowed */
const char *fw_report_rejected(const fw_verdict *verdict);
const char *fw_report_decision_word(fw_verdict_decision decision); /* "ACCEPT" ... */
/* `colour` when it reads #rgb or #rrggbb, else entry `index` of the palette */
const char *fw_report_layer_colour(const char *colour, int index);

/* ---- figure.c: from the plane to picture coordinates, y down ---- */
typedef struct fw_report_view {
    double x0_m, y1_m, scale; /* pixel per m */
    double width, height;
} fw_report_view;
/* the whole pixels that a picture of this height takes: a millionth of one is round-off, and would make another picture of the
   same device with another library of linear algebra */
double fw_report_whole_pixels(double height);
fw_report_view fw_report_view_fit(fw_geometry_box box, double width, double pad_m);
double fw_report_x(const fw_report_view *view, double x_m);
double fw_report_y(const fw_report_view *view, double y_m);
void fw_report_path(fw_text *out, const fw_report_view *view, const fw_geometry_contour *contour);
/* path of all rigid pieces of a body */
void fw_report_body_path(const fw_layout *layout, int body, const fw_report_view *view,
                         fw_text *out);
fw_geometry_box fw_report_box_empty(void);
void fw_report_box_add(fw_geometry_box *box, double x_m, double y_m);
/* hinge point of a joint in the drawn position */
fw_geometry_vec2 fw_report_hinge_point(const fw_device *device, const fw_layout *layout, int joint);
/* there are outlines to show: of a layout that cannot be made, too */
bool fw_report_drawn(const fw_layout *layout);
bool fw_report_outlined(const fw_layout *layout, int body); /* the body has a shape of its own */

/* ---- film.c: bodies and bending flexures at an instant ---- */
typedef struct fw_report_bend_point {
    double x_m, y_m;
    double weight; /* share of the upper body's turn about the hinge point with which it goes */
} fw_report_bend_point;
typedef struct fw_report_bend {
    const fw_layout_piece *piece;
    fw_geometry_vec2 centre; /* hinge point */
    int lower, upper;        /* bodies */
    int joint;
    fw_report_bend_point *point; /* (npoint) closed outline */
    int npoint;
} fw_report_bend;
typedef struct fw_report_bends {
    fw_report_bend *item; /* (count) */
    int count;
} fw_report_bends;
fw_status fw_report_bends_make(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                               fw_report_bends *bends);
/* pose of a body between the samples; ground rests at zero. pose: x, y (m), angle (rad) */
void fw_report_pose_at(const fw_dynamics_motion *motion, int body, double t_s, double pose[3]);
/* where the point (x, y) of the drawn position is when `body` has moved to its pose at t */
fw_geometry_vec2 fw_report_moved(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                 int body, double t_s, fw_geometry_vec2 drawn);
fw_geometry_vec2 fw_report_bent(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                                const fw_report_bend *bend, double t_s, fw_report_bend_point point);
/* adds where the hinge points of all bodies get to */
void fw_report_reach_add(fw_geometry_box *box, const fw_device *device, const fw_layout *layout,
                         const fw_mechanism *mechanism, const fw_dynamics_motion *motion);
/* largest peak over limit of the scene, its instant; pin FW_NONE when nothing is limited */
typedef struct fw_report_worst {
    int pin;
    double utilisation, t_s;
} fw_report_worst;
fw_report_worst fw_report_motion_worst(const fw_mechanism *mechanism,
                                       const fw_dynamics_motion *motion);
double fw_report_pin_limit(const fw_mechanism *mechanism, int pin); /* rad; NaN: none */

/* ---- film.c: a mechanism that moves ---- */
typedef struct fw_report_film {
    const fw_device *device;
    const fw_layout *layout; /* NULL or not drawn: bodies as lines between their joints */
    const fw_mechanism *mechanism;
    const fw_dynamics_motion *motion; /* from its first to its last sample */
    const fw_report_view *view;
    fw_text *out;
    int frames;     /* key frames, more where bodies turn far; 0: a still picture */
    int seconds;    /* time to play */
    double still_s; /* instant that viewers without animation show */
    bool ghost;     /* the first sample too, dashed */
    bool small;     /* for small pictures */
} fw_report_film;
/* everything that belongs into the <svg> except caption and scale bar */
fw_status fw_report_film_draw(fw_arena *arena, const fw_report_film *film);
/* `count` poses q (count x 3 nbody) as a motion from t = 0 to 1 */
fw_status fw_report_poses(fw_arena *arena, const fw_mechanism *mechanism, int count, double *q,
                          fw_dynamics_motion *motion);
/* adds where everything gets to */
fw_status fw_report_poses_reach(fw_arena *arena, fw_geometry_box *box, const fw_layout *layout,
                                const fw_mechanism *mechanism, const fw_dynamics_motion *motion);
/* a view of that; where the device is drawn, of the whole of it too */
fw_report_view fw_report_poses_view(const fw_device *device, const fw_layout *layout,
                                    const fw_geometry_box *reach, double width);

/* ---- plot.c: hinge angles against time ---- */
/* at most `most` indices that keep the first, the last and every extreme; returns how many */
int fw_report_decimate(const double *y, int stride, int count, int most, int *index);

/* one panel per pin; at most FW_REPORT_PANELS of them, the most used ones */
enum { FW_REPORT_PANELS = 12, FW_REPORT_CURVE = 400 };
typedef struct fw_report_figure {
    int columns, curve_points;
    bool standalone; /* a file of its own: with a heading */
    const char *title;
} fw_report_figure;
fw_status fw_report_panels(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_dynamics_motion *motion, const fw_report_figure *figure,
                           fw_text *out);

/* a curve against time: where it is and what its axes show */
enum { FW_REPORT_PANEL_WIDTH = 344, FW_REPORT_PANEL_HEIGHT = 208 };
typedef struct fw_report_axes {
    double x, y; /* of the plot area, top left */
    double width, height;
    double t_end, time_unit; /* s */
    const char *time_name;
    double low, high; /* in the unit of the curve */
} fw_report_axes;
/* the i-th panel of a figure of `columns` whose panels begin at `top` */
fw_report_axes fw_report_axes_at(const fw_dynamics_motion *motion, int i, int columns, double top);
double fw_report_axes_x(const fw_report_axes *a, double t_s);
double fw_report_axes_y(const fw_report_axes *a, double value);
void fw_report_axes_draw(const fw_report_axes *a, fw_text *out);

/* ---- report_requirements.c: probes of a scene against time, with what is required of them ---- */
/* nothing where the scene has none */
fw_status fw_report_probe_panels(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                 const fw_report_figure *figure, fw_text *out);

/* ---- drawing.c: the device ---- */
/* what the pictures show: the mechanism at rest and, with `reach`, where its hinges get to */
fw_report_view fw_report_device_view(const fw_device *device, const fw_layout *layout,
                                     const fw_geometry_box *reach, double width);
void fw_report_scale_bar_svg(fw_text *out, const fw_report_view *view);
/* what stands below the drawing: colours, and the rows of what is marked */
fw_status fw_report_legend_height(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_verdict *verdict, double *height);
/* everything inside the <svg> of the device drawing; `ids` adds ids that figures may <use> */
fw_status fw_report_drawing(const fw_device *device, const fw_layout *layout,
                            const fw_verdict *verdict, const fw_report_view *view, bool ids,
                            fw_text *out);
double fw_report_joint_utilisation(const fw_verdict *verdict, int joint); /* NaN: none */

/* ---- report_actuators.c ---- */
typedef struct fw_report_canvas { /* where shapes are drawn; coordinates of the picture */
    /* through n points xy (2 n), closed and filled where `fill` is not NULL */
    void (*path)(void *to, const double *xy, int n, const char *fill, const char *ink, double width,
                 bool dashed);
    void (*circle)(void *to, double x, double y, double r, const char *fill, const char *ink,
                   double width);
    void (*label)(void *to, double x, double y, const char *text); /* NULL: without names */
    void *to;
    double px; /* what a pixel of the usual picture of 640 is here */
} fw_report_canvas;
/* tendons and electrodes of all scenes, over the drawing */
void fw_report_actuators(const fw_device *device, const fw_layout *layout,
                         const fw_report_view *view, const fw_report_canvas *canvas);
void fw_report_actuators_svg(const fw_device *device, const fw_layout *layout,
                             const fw_report_view *view, fw_text *out);
/* adds where tendons and electrodes lead */
void fw_report_actuators_reach(const fw_device *device, const fw_layout *layout,
                               fw_geometry_box *box);

/* ---- sections of the page ---- */
typedef struct fw_report_page {
    fw_arena *arena;
    fw_text *out;
    const fw_report_input *in;
    fw_report_view view; /* of the drawing and of all animations */
    int nmotion;         /* motions in the whole page */
} fw_report_page;
fw_status fw_report_banner(fw_report_page *page);
void fw_report_advice(fw_report_page *page);
/* masses, stiffnesses, dampings as used, per flow */
void fw_report_mechanics(fw_report_page *page);
fw_status fw_report_section_device(fw_report_page *page);
fw_status fw_report_section_hinges(fw_report_page *page);
fw_status fw_report_section_clearance(fw_report_page *page);
fw_status fw_report_section_out_of_plane(fw_report_page *page);
bool fw_report_has_out_of_plane(const fw_report_page *page);
fw_status fw_report_section_stiction(fw_report_page *page);
bool fw_report_has_stiction(const fw_report_page *page); /* report_requirements.c */
fw_status fw_report_section_fabricated(fw_report_page *page);
fw_status fw_report_section_measurements(fw_report_page *page); /* banner.c */
bool fw_report_has_measurements(const fw_report_page *page);
bool fw_report_has_requirements(const fw_report_page *page);
fw_status fw_report_section_requirements(fw_report_page *page);
/* a clause on bands of a device that is not drawn; rigid: names of its bodies */
const char *fw_report_without_bodies(fw_arena *arena, const char *rigid);
fw_status fw_report_section_motion(fw_report_page *page);
fw_status fw_report_section_workspace(fw_report_page *page);
fw_status fw_report_section_flows(fw_report_page *page);
fw_status fw_report_section_masks(fw_report_page *page);
fw_status fw_report_section_recipes(fw_report_page *page);
fw_status fw_report_section_effects(fw_report_page *page);
fw_status fw_report_section_accuracy(fw_report_page *page);
fw_status fw_report_section_assumptions(fw_report_page *page);
/* what the band of a hinge is made of, the widest part first: "the law of the peak at a root, -1.1 and +0.8 %; ..." of what it
   uses; false: it has none */
bool fw_report_band_words(fw_text *out, const fw_verdict_hinge_verdict *h);
/* table of hinge verdicts; `with_flow` adds the column */
void fw_report_hinge_table(fw_text *out, const fw_verdict_hinge_verdict *hinge, int nhinge,
                           bool with_flow, const char *caption);

/* ---- ledger.c: how hinges were taken, and what the next level changes ---- */

/* lines for a terminal; none without hinges */
void fw_report_hinge_model(const fw_mechanism *mechanism, const fw_effects_hinge_use *use,
                           const fw_statics_level_step *level, fw_text *out);

/* ---- drawing_marks.c: what pictures mark in the warning colour ----
   Why a layout cannot be made, and why a device is rejected, each with a number in the picture and a row
   below it. */

typedef struct fw_report_mark {
    int number;          /* FW-Dnnn; 0: the hinge's own limit */
    const char *label;   /* a few words */
    const char *text;    /* a sentence */
    const char *of;      /* probe; NULL */
    fw_geometry_vec2 at; /* world; NaN: no one place */
    int body[2], nbody;  /* concerned; FW_GROUND, FW_ISLAND */
    int joint[2], njoint;
    const fw_geometry_region *overlap; /* NULL or empty: none */
} fw_report_mark;

typedef struct fw_report_marks {
    fw_report_mark *item; /* (count) in the order of their numbers, from 1 */
    int count;
} fw_report_marks;

/* layout and verdict may be NULL; none of a device that is not rejected and can be drawn */
fw_status fw_report_marks_of(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict *verdict, fw_report_marks *marks);
extern const char fw_report_mark_colour[];
/* over the drawing; and over its names, the numbers beside their places */
void fw_report_marks_tags(const fw_device *device, const fw_layout *layout,
                          const fw_report_marks *marks, const fw_report_view *view, fw_text *out);
void fw_report_marks_svg(const fw_device *device, const fw_layout *layout,
                         const fw_report_marks *marks, const fw_report_view *view, fw_text *out);
/* the rows below it, and how high they are */
fw_status fw_report_marks_legend(fw_arena *arena, const fw_report_marks *marks, double width,
                                 double top, fw_text *out);
double fw_report_marks_height(const fw_report_marks *marks);

/* ---- summary.c: the top of every result ----
   For the terminal, the page, the report and programs alike: the decision, why, what governs as it will be
   fabricated and as drawn, what to do, and what is not guaranteed with the measurement that would settle
   it. */

typedef struct fw_report_summary_line {
    const char *label; /* "rejected because", "as made, at worst", "do", "nearest", ... */
    const char *text;  /* a sentence without its full stop */
} fw_report_summary_line;

typedef struct fw_report_summary {
    fw_verdict_decision decision;
    fw_verdict_check made, drawn; /* of the hinges, those that govern */
    bool has_made, has_drawn;     /* has_made: a flow was judged as it makes it */
    /* of all checks, as made where that was judged, and as drawn */
    fw_verdict_check governing, governing_drawn;
    bool governs;       /* something was run */
    const char *unmade; /* flows that cannot make what is not rejected; NULL: none is known */
    const char
        *dies; /* "342 of 514 dies are inconclusive in FLOW"; NULL: none is worse than the device */
    fw_report_summary_line *line; /* (nline) in the order in which they are read */
    int nline;
} fw_report_summary;

fw_status fw_report_summarise(fw_arena *arena, const fw_report_input *input,
                              fw_report_summary *summary);

/* ---- figure_pdf_file.c: for figures as PDF ---- */

typedef struct fw_report_pdf { /* one page of so many points */
    double wide, high;
    const fw_text *page;
    double (*state)[2]; /* (nstate) opacities of fills and lines, named G0, G1, ... */
    fw_text *form;      /* (nform) what the page repeats, named X0, X1, ... */
    int nstate, nform;
} fw_report_pdf;

typedef struct fw_report_letter {
    int font; /* 1, 2: Helvetica, bold; 3: Symbol */
    unsigned char code;
    bool raised;  /* a small one above the line, of FW_REPORT_PDF_SMALL times the size */
    double width; /* of the size */
} fw_report_letter;
#define FW_REPORT_PDF_SMALL 0.6
#define FW_REPORT_PDF_RISE  0.33
/* false: none of them has it */
bool fw_report_letter_of(unsigned u, bool bold, fw_report_letter *letter);
void fw_report_pdf_file(const fw_report_pdf *parts, fw_text *pdf);

/* operators: numbers and a word; outlines from what SVG says of them, false: they are none */
void fw_report_pdf_numbers(fw_text *out, const double *v, int n, const char *operator);
void fw_report_pdf_matrix(fw_text *out, const double *m);
void fw_report_pdf_rectangle(fw_text *out, const double *box, double rx, double ry);
void fw_report_pdf_ellipse(fw_text *out, double x, double y, double rx, double ry);
bool fw_report_pdf_points(fw_text *out, const char *points, bool closed);
bool fw_report_pdf_path(fw_text *out, const char *d);
/* an element's attribute transform; NULL: it has none */
void fw_report_pdf_transform(fw_text *out, const char *transform);
/* how many numbers a list begins with, at most `most`; NULL: none */
int fw_report_pdf_list(const char *list, int most, double *v);
/* points of a size that may have a unit */
double fw_report_pdf_size(const char *size);

#endif
