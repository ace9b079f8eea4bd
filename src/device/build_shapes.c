/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a body is drawn of: <outline> from lines and arcs or from a file, <plate>, <bar>, <disc>,
   <lettering>. Each becomes closed outlines in the body's frame, each copy and mirror image one of
   its own. Lines and arcs stay exact. */
#include "base/constants.h"
#include "device/device_reader.h"
#include "drawing/drawing.h"
#include "geometry/segment.h"
#include <math.h>
#include <string.h>

enum { SHAPES_MOST = 2000 }; /* of one body, copies counted */

typedef struct builder {
    fw_device_reader *r;
    fw_device_body *body;
    const fw_xml_record *record; /* of the shape */
    char label[FW_LABEL];
    fw_device_shape *shape; /* (count) */
    int count, room, segments;
} builder;

static const char *const elements[] = {"outline", "plate", "bar", "disc", "lettering", NULL};

int fw_device_shapes_given(const fw_xml_record *record) {
    int n = 0;
    for (const char *const *name = elements; *name; name++)
        n += fw_xml_children(record, *name);
    return n - fw_xml_children(record, "lettering"); /* which only takes away */
}

static bool word_is(const fw_xml_record *record, const char *name, const char *word) {
    const char *given = fw_xml_text_of(record, name);
    return given && strcmp(given, word) == 0;
}

static bool any_failed(const fw_xml_record *record) {
    for (int i = 0; i < record->nattribute; i++)
        if ((record->cell[i].given || record->cell[i].missing) && !record->cell[i].ok) return true;
    return false;
}

static void say(builder *b, int number, const char *attribute, const char *what) {
    fw_diag_error(b->r->diags, number,
                  attribute ? fw_xml_place_of(b->record, attribute) : b->record->element->place,
                  "%s of body '%s': %s", b->label, b->body->id ? b->body->id : "", what);
}

/* ---- copies ---- */

static fw_status add(builder *b, fw_device_shape shape) {
    b->segments += shape.contour.count;
    if (b->count == SHAPES_MOST || b->segments > FW_DRAWING_SEGMENTS_MOST) {
        if (b->room >= 0)
            fw_diag_error(b->r->diags, 319, b->record->element->place,
                          "body '%s' is drawn of more than %d shapes or %d lines and arcs, copies "
                          "counted; draw less, or use several bodies",
                          b->body->id ? b->body->id : "", (int)SHAPES_MOST,
                          (int)FW_DRAWING_SEGMENTS_MOST);
        b->room = -1; /* said once */
        return FW_OK;
    }
    if (b->room < 0) return FW_OK;
    if (b->count == b->room) {
        int more = b->room ? 2 * b->room : 16;
        FW_NEED(b->shape = fw_arena_grow(b->r->arena, b->shape, (size_t)b->count, (size_t)more,
                                         sizeof *b->shape));
        b->room = more;
    }
    b->shape[b->count++] = shape;
    return FW_OK;
}

/* one outline and its mirror images about the axes of the body's frame */
static fw_status add_symmetric(builder *b, const fw_geometry_contour *contour, bool hole) {
    bool both = word_is(b->record, "symmetry", "both");
    bool about[3] = {both || word_is(b->record, "symmetry", "x"),
                     both || word_is(b->record, "symmetry", "y"), both};
    fw_device_shape shape = {.contour = *contour, .hole = hole, .place = b->record->element->place};
    FW_TRY(add(b, shape));
    /* y -> -y; x -> -x is that and half a turn; both is half a turn */
    static const struct {
        double turn_rad;
        bool mirrored;
    } image[3] = {{0, true}, {FW_PI, true}, {FW_PI, false}};
    for (int i = 0; i < 3; i++) {
        if (!about[i]) continue;
        FW_TRY(fw_geometry_contour_transform(b->r->arena, contour,
                                             (fw_geometry_pose){0, 0, image[i].turn_rad},
                                             image[i].mirrored, &shape.contour));
        FW_TRY(add(b, shape));
    }
    return FW_OK;
}

/* an outline in the body's frame: its copies, and their mirror images */
static fw_status add_copies(builder *b, const fw_geometry_contour *contour, bool nested) {
    const fw_xml_record *record = b->record;
    int copies = fw_xml_whole_or(record, "copies", 1);
    double dx = fw_xml_number_or(record, "pitch-x", 0), dy = fw_xml_number_or(record, "pitch-y", 0);
    bool hole = word_is(record, "hole", "yes") != nested;
    for (int i = 0; i < copies && b->room >= 0; i++) {
        fw_geometry_contour moved;
        FW_TRY(fw_geometry_contour_transform(b->r->arena, contour,
                                             (fw_geometry_pose){i * dx, i * dy, 0}, false, &moved));
        FW_TRY(add_symmetric(b, &moved, hole));
    }
    return FW_OK;
}

static bool repeats_are_sound(builder *b) {
    const fw_xml_record *record = b->record;
    double copies = fw_xml_number_or(record, "copies", 1);
    bool pitch = fw_xml_given(record, "pitch-x") || fw_xml_given(record, "pitch-y");
    bool moves =
        fw_xml_number_or(record, "pitch-x", 0) != 0 || fw_xml_number_or(record, "pitch-y", 0) != 0;
    if (copies > 1 && !moves)
        say(b, 309, "copies", "several copies lie on one place; add pitch-x or pitch-y");
    else if (pitch && !fw_xml_given(record, "copies"))
        say(b, 309, fw_xml_given(record, "pitch-x") ? "pitch-x" : "pitch-y",
            "a pitch is the distance of copies; add copies, or remove it");
    else
        return true;
    return false;
}

/* ---- corners ---- */

static bool was_there(const fw_geometry_contour *before, const fw_geometry_segment *s) {
    for (int i = 0; i < before->count; i++)
        if (before->segment[i].kind == FW_ARC &&
            vec_distance(before->segment[i].centre, s->centre) < FW_COINCIDENT_M)
            return true;
    return false;
}

/* what rounding makes smaller than stated is refused */
static fw_status round_corners(builder *b, fw_geometry_contour *contour, bool *good) {
    double radius = fw_xml_number_or(b->record, "corner", 0);
    fw_geometry_contour round;
    fw_geometry_vec2 where = {0, 0};
    char x[FW_LABEL], y[FW_LABEL];
    *good = true;
    if (!(radius > 0)) return FW_OK;
    fw_status status =
        fw_geometry_contour_round(b->r->arena, contour, radius, radius, &round, &where);
    if (status != FW_GEOMETRY) FW_TRY(status);
    *good = status == FW_OK;
    for (int i = 0; *good && i < round.count; i++) {
        const fw_geometry_segment *s = &round.segment[i];
        if (s->kind != FW_ARC || s->radius >= radius * (1 - 1e-9) || was_there(contour, s))
            continue;
        *good = false;
        where = s->a;
    }
    if (*good)
        *contour = round;
    else
        fw_diag_error(b->r->diags, 308, fw_xml_place_of(b->record, "corner"),
                      "%s of body '%s': there is no room for this radius at the corner near (%s, "
                      "%s) in its own axes; make it smaller",
                      b->label, b->body->id ? b->body->id : "", fw_xml_in_unit(x, where.x, "um"),
                      fw_xml_in_unit(y, where.y, "um"));
    return FW_OK;
}

/* ---- outlines of lines and arcs ---- */

typedef struct path {
    fw_drawing_piece *piece;      /* (n) */
    const fw_xml_record **record; /* (n) */
    int n;
} path;

/* sweep of an arc from `from`; 0: reported */
static double sweep_of(builder *b, const fw_xml_record *arc, fw_geometry_vec2 from,
                       fw_geometry_vec2 to) {
    double half = 0.5 * vec_distance(from, to), radius = fw_xml_number_of(arc, "radius");
    char r[FW_LABEL], h[FW_LABEL];
    if (half <= 0.5 * FW_DRAWING_SAME_M) return 1; /* without length, which is said of any piece */
    if (radius < half - FW_DRAWING_SAME_M) {
        fw_diag_error(b->r->diags, 306, fw_xml_place_of(arc, "radius"),
                      "%s of body '%s': an arc of radius %s does not reach from one end to the "
                      "other, which is %s away; write a radius of at least half of that",
                      b->label, b->body->id ? b->body->id : "", fw_xml_in_unit(r, radius, "um"),
                      fw_xml_in_unit(h, 2 * half, "um"));
        return 0;
    }
    double sweep = 2 * asin(fmin(1, half / radius));
    if (word_is(arc, "large", "yes")) sweep = 2 * FW_PI - sweep;
    return word_is(arc, "turn", "right") ? -sweep : sweep;
}

/* the children in their order; *good false: something is wrong and said */
static fw_status read_path(builder *b, path *p, fw_geometry_vec2 start, bool *good) {
    int n = fw_xml_children(b->record, "line") + fw_xml_children(b->record, "arc");
    FW_NEED(p->piece = fw_arena_array(b->r->arena, fw_drawing_piece, (size_t)n));
    FW_NEED(p->record = fw_arena_array(b->r->arena, const fw_xml_record *, (size_t)n));
    fw_geometry_vec2 at = start;
    *good = !any_failed(b->record);
    for (const fw_xml_record *c = b->record->first_child; c; c = c->next) {
        bool arc = fw_xml_is(c, "arc");
        if (any_failed(c)) *good = false;
        if (!*good) continue;
        fw_geometry_vec2 to = {fw_xml_number_of(c, "to-x"), fw_xml_number_of(c, "to-y")};
        double sweep = arc ? sweep_of(b, c, at, to) : 0;
        *good = !arc || sweep != 0;
        p->piece[p->n] = (fw_drawing_piece){to, sweep};
        p->record[p->n++] = c;
        at = to;
    }
    return FW_OK;
}

static void say_flaw(builder *b, const path *p, const fw_drawing_flaw *flaw) {
    char x[FW_LABEL], y[FW_LABEL];
    const fw_xml_record *at = p->record[flaw->piece];
    const char *body = b->body->id ? b->body->id : "";
    fw_diags *diags = b->r->diags;
    fw_xml_in_unit(x, flaw->at.x, "um");
    fw_xml_in_unit(y, flaw->at.y, "um");
    switch (flaw->fault) {
    case FW_DRAWING_OPEN:
        fw_diag_error(diags, 305, at->element->place,
                      "%s of body '%s' is not closed: its last piece ends at (%s, %s), and the "
                      "first begins elsewhere; add a <line> or <arc> back to the start",
                      b->label, body, x, y);
        break;
    case FW_DRAWING_POINT:
        fw_diag_error(diags, 307, at->element->place,
                      "%s of body '%s': this piece ends at (%s, %s) where it begins; remove it",
                      b->label, body, x, y);
        break;
    case FW_DRAWING_CROSSES:
        fw_diag_error(diags, 307, at->element->place,
                      "%s of body '%s': this piece crosses or touches the one of line %d at (%s, "
                      "%s); an outline meets itself nowhere: move a point, or draw two outlines",
                      b->label, body, p->record[flaw->other]->element->place.line, x, y);
        break;
    case FW_DRAWING_FLAT:
    case FW_DRAWING_SOUND:
        say(b, 307, NULL, "it encloses no area; it needs at least three lines, or an arc");
        break;
    }
}

/* from its own axes into the body's frame */
static fw_status place_outline(builder *b, const fw_geometry_contour *own, bool nested) {
    const fw_xml_record *record = b->record;
    bool about_x = word_is(record, "mirror", "x"), about_y = word_is(record, "mirror", "y");
    double angle = fw_xml_number_or(record, "angle", 0) + (about_y ? FW_PI : 0);
    fw_geometry_pose pose = {fw_xml_number_or(record, "x", 0), fw_xml_number_or(record, "y", 0),
                             angle};
    fw_geometry_contour round = *own, placed;
    bool good;
    FW_TRY(round_corners(b, &round, &good));
    if (!good) return FW_OK;
    FW_TRY(fw_geometry_contour_transform(b->r->arena, &round, pose, about_x || about_y, &placed));
    return add_copies(b, &placed, nested);
}

static fw_status own_outline(builder *b) {
    static const char *const of_files[] = {"layer", "cell", "unit"};
    path p = {0};
    bool good;
    fw_geometry_vec2 start = {fw_xml_number_or(b->record, "start-x", 0),
                              fw_xml_number_or(b->record, "start-y", 0)};
    for (int i = 0; i < 3; i++)
        if (fw_xml_given(b->record, of_files[i]))
            say(b, 309, of_files[i], "this belongs to a file; add file, or remove it");
    FW_TRY(read_path(b, &p, start, &good));
    if (!good) return FW_OK;
    if (p.n == 0) {
        if (!b->r->xml.unknown_element)
            say(b, 305, NULL,
                "it has neither <line> and <arc> inside nor a file; add one or the other");
        return FW_OK;
    }
    if (p.n > FW_DRAWING_SEGMENTS_MOST) {
        say(b, 319, NULL, "it has more than 4000 lines and arcs; draw fewer");
        return FW_OK;
    }
    fw_geometry_contour contour;
    fw_drawing_flaw flaw;
    fw_status status = fw_drawing_trace(b->r->arena, start, p.piece, p.n, &contour, &flaw);
    if (status == FW_GEOMETRY) {
        say_flaw(b, &p, &flaw);
        return FW_OK;
    }
    FW_TRY(status);
    return place_outline(b, &contour, false);
}

/* ---- outlines of files ---- */

/* beside or below the device file, whatever the machine: no drive, no root, no way up */
static bool name_is_sound(const char *name) {
    size_t n = strlen(name);
    if (n == 0 || n > 255 || name[0] == '/' || strpbrk(name, "\\:")) return false;
    for (const char *at = name; *at;) {
        size_t part = strcspn(at, "/");
        if (part == 0 || (part == 2 && memcmp(at, "..", 2) == 0) || (part == 1 && *at == '.'))
            return false;
        at += part + (at[part] == '/');
        if (at[-1] == '/' && *at == '\0') return false;
    }
    for (size_t i = 0; i < n; i++)
        if ((unsigned char)name[i] < ' ') return false;
    return true;
}

fw_status fw_device_drawing_open(fw_device_reader *r, const fw_xml_record *record,
                                 const char **data, size_t *n) {
    const char *name = fw_xml_text_of(record, "file");
    fw_place place = fw_xml_place_of(record, "file");
    char label[FW_LABEL];
    fw_xml_label(record, label);
    if (!name_is_sound(name))
        return fw_diag_error(r->diags, 310, place,
                             "%s: a drawing lies beside the device file or below: a relative name "
                             "without \"..\", ':' and backslashes; move or copy it there",
                             label);
    if (!r->files)
        return fw_diag_error(r->diags, 311, place,
                             "%s: files are not opened for a description that is not a file itself "
                             "(of the page or of standard input); run flexwright on the device "
                             "file%s",
                             label, fw_xml_is(record, "cell") ? "" : ", or draw <line> and <arc>");
    return r->files->read(r->files->of, name, place, data, n);
}

double fw_device_drawing_unit_m(const char *unit) {
    static const struct {
        const char *name;
        double metres;
    } known[] = {{"um", 1e-6}, {"nm", 1e-9},    {"mm", 1e-3},    {"cm", 1e-2},
                 {"m", 1},     {"in", 25.4e-3}, {"mil", 25.4e-6}};
    for (size_t i = 0; unit && i < sizeof known / sizeof known[0]; i++)
        if (strcmp(known[i].name, unit) == 0) return known[i].metres;
    return (double)NAN;
}

static bool file_stands_alone(builder *b) {
    static const char *const of_paths[] = {"start-x", "start-y"};
    bool good = true;
    for (int i = 0; i < 2; i++) {
        if (!fw_xml_given(b->record, of_paths[i])) continue;
        say(b, 309, of_paths[i], "the lines are those of the file; remove it, or use x and y");
        good = false;
    }
    if (b->record->first_child) {
        fw_diag_error(b->r->diags, 309, b->record->first_child->element->place,
                      "%s of body '%s' is drawn from a file; remove its lines and arcs, or file",
                      b->label, b->body->id ? b->body->id : "");
        good = false;
    }
    return good;
}

static fw_status file_outline(builder *b) {
    const fw_xml_record *record = b->record;
    const char *name = fw_xml_text_of(record, "file"), *unit = fw_xml_text_of(record, "unit");
    fw_drawing_asked asked = {.file = name,
                              .layer = fw_xml_text_of(record, "layer"),
                              .cell = fw_xml_text_of(record, "cell"),
                              .unit = unit,
                              .unit_m = fw_device_drawing_unit_m(unit),
                              .place = fw_xml_place_of(record, "file"),
                              .unit_place = fw_xml_place_of(record, "unit"),
                              .cell_place = fw_xml_place_of(record, "cell"),
                              .layer_place = fw_xml_place_of(record, "layer")};
    const char *data;
    size_t n;
    fw_drawing drawing;
    if (!name || !file_stands_alone(b)) return FW_OK; /* misspelt: that was reported */
    fw_status status = fw_device_drawing_open(b->r, record, &data, &n);
    if (status == FW_OK)
        status = fw_drawing_read(b->r->arena, data, n, &asked, b->r->diags, &drawing);
    if (status == FW_INPUT || status == FW_IO || status == FW_LIMIT) return FW_OK; /* reported */
    FW_TRY(status);
    for (int i = 0; i < drawing.count; i++)
        if (drawing.outline[i].hole && word_is(record, "hole", "yes")) {
            say(b, 309, "hole",
                "the file has one closed line within another: what is between them would be cut "
                "out and the inner part fall out; put it on a layer of its own");
            return FW_OK;
        }
    for (int i = 0; i < drawing.count && b->room >= 0; i++)
        FW_TRY(place_outline(b, &drawing.outline[i].contour, drawing.outline[i].hole));
    return FW_OK;
}

static fw_status build_outline(builder *b) {
    return fw_xml_given(b->record, "file") ? file_outline(b) : own_outline(b);
}

/* ---- plates, bars, discs, lettering ---- */

static fw_status build_plate(builder *b) {
    double w = 0.5 * fw_xml_number_of(b->record, "width");
    double h = 0.5 * fw_xml_number_of(b->record, "height");
    fw_geometry_pose pose = {fw_xml_number_or(b->record, "x", 0),
                             fw_xml_number_or(b->record, "y", 0),
                             fw_xml_number_or(b->record, "angle", 0)};
    fw_geometry_contour own, placed;
    bool good;
    FW_TRY(fw_geometry_contour_rectangle(b->r->arena, (fw_geometry_box){-w, -h, w, h}, &own));
    FW_TRY(round_corners(b, &own, &good));
    if (!good) return FW_OK;
    FW_TRY(fw_geometry_contour_transform(b->r->arena, &own, pose, false, &placed));
    return add_copies(b, &placed, false);
}

/* two lines and, with round ends, two half circles */
static fw_status build_bar(builder *b) {
    const fw_xml_record *record = b->record;
    fw_geometry_vec2 p = {fw_xml_number_or(record, "x", 0), fw_xml_number_or(record, "y", 0)};
    fw_geometry_vec2 q = {fw_xml_number_of(record, "to-x"), fw_xml_number_of(record, "to-y")};
    double half = 0.5 * fw_xml_number_of(record, "width");
    bool round = word_is(record, "ends", "round"), good;
    if (vec_distance(p, q) <= FW_DRAWING_SAME_M) {
        say(b, 307, "to-x", "it ends where it begins; move one of its points, or draw a <disc>");
        return FW_OK;
    }
    if (round && fw_xml_given(record, "corner")) {
        say(b, 309, "corner", "a bar with round ends has no corners; remove it");
        return FW_OK;
    }
    fw_geometry_vec2 side = vec_scale(half, vec_left(vec_unit(vec_sub(q, p))));
    const fw_drawing_piece piece[4] = {{vec_sub(q, side), 0},
                                       {vec_add(q, side), round ? FW_PI : 0},
                                       {vec_add(p, side), 0},
                                       {vec_sub(p, side), round ? FW_PI : 0}};
    fw_geometry_contour own;
    fw_drawing_flaw flaw;
    fw_status status = fw_drawing_trace(b->r->arena, piece[3].to, piece, 4, &own, &flaw);
    if (status == FW_GEOMETRY) {
        say(b, 307, NULL, "it encloses no area; make it longer or wider");
        return FW_OK;
    }
    FW_TRY(status);
    FW_TRY(round_corners(b, &own, &good));
    return good ? add_copies(b, &own, false) : FW_OK;
}

static fw_status build_disc(builder *b) {
    double r = fw_xml_number_of(b->record, "radius");
    fw_geometry_vec2 c = {fw_xml_number_or(b->record, "x", 0), fw_xml_number_or(b->record, "y", 0)};
    const fw_drawing_piece piece[2] = {{{c.x - r, c.y}, FW_PI}, {{c.x + r, c.y}, FW_PI}};
    fw_geometry_contour own;
    fw_drawing_flaw flaw;
    FW_TRY(fw_drawing_trace(b->r->arena, piece[1].to, piece, 2, &own, &flaw));
    return add_copies(b, &own, false);
}

static fw_status build_lettering(builder *b) {
    const fw_xml_record *record = b->record;
    return add(b, (fw_device_shape){.hole = true,
                                    .text = fw_xml_text_of(record, "text"),
                                    .height_m = fw_xml_number_or(record, "height", 72e-6),
                                    .pose = {fw_xml_number_or(record, "x", 0),
                                             fw_xml_number_or(record, "y", 0),
                                             fw_xml_number_or(record, "angle", 0)},
                                    .place = record->element->place});
}

/* ---- the whole ---- */

fw_status fw_device_build_shapes(fw_device_reader *r, const fw_xml_record *record,
                                 fw_device_body *body) {
    static fw_status (*const build[])(builder * b) = {build_outline, build_plate, build_bar,
                                                      build_disc, build_lettering};
    builder b = {.r = r, .body = body};
    body->nshape = 0;
    for (const fw_xml_record *c = record->first_child; c; c = c->next) {
        b.record = c;
        fw_xml_label(c, b.label);
        for (int i = 0; elements[i]; i++) {
            if (!fw_xml_is(c, elements[i])) continue;
            bool plain = strcmp(elements[i], "lettering") == 0 || repeats_are_sound(&b);
            bool ready = strcmp(elements[i], "outline") == 0 || !any_failed(c);
            if (plain && ready) FW_TRY(build[i](&b));
        }
    }
    body->shape = b.shape;
    body->nshape = b.count;
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
