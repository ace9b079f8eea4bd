/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexwright as a library: from one description of a planar compliant micromanipulator to a verdict
   (does any flexure hinge leave its elastic range?), mask layouts and computed recipes.

       fw_design_options options = fw_design_options_default();
       fw_design *design = fw_design_new(&options);
       if (fw_design_read(design, "device.xml") == FW_STATUS_OK &&
           fw_design_judge(design) == FW_STATUS_OK)
           printf("decision %d\n", fw_design_decision(design));
       fw_design_free(design);

   Ownership: a design owns all that it computed and every pointer that it hands out; they live
   until fw_design_free. What you pass in (options, strings, bytes) is copied and yours again on
   return.

   Errors: a function that can fail returns a status (FW_STATUS_...), FW_STATUS_OK = 0. What a
   person should know is in the diagnostics. A rejected design is a result, not an error. NULL where
   a value is needed, and calls in the wrong order, are FW_STATUS_USAGE; nothing ends the process,
   nothing is printed. After a status other than FW_STATUS_OK the design can still be asked for its
   diagnostics and freed.

   Threads: one design belongs to one thread at a time; any number of designs may work in parallel
   in different threads. The same description and options give the same bytes in any thread and any
   locale (measured CPU times in FW_DOCUMENT_SIMULATE_... and FW_DOCUMENT_PREVIEW_JSON excepted).
   fw_library_version, fw_status_name, fw_design_options_init, fw_design_cancel and
   fw_design_cancel_clear may be called from any thread at any time.

   Later versions add: functions, numbers at the end of an enum, fields at the end of a struct. A program
   that was compiled with an earlier header of the same SONAME runs with a later library; never make an
   array of fw_diagnostic or fw_array, whose size may grow.

   The library reads no environment variable, keeps no file open between calls, changes no locale of
   the caller and installs no signal handler. It turns off the error handler of GSL (which would end
   the process) for the whole process. */
#ifndef FLEXWRIGHT_H
#define FLEXWRIGHT_H
#include <stddef.h>
#include <stdint.h>

#ifndef FW_API
#if defined(__GNUC__)
#define FW_API __attribute__((visibility("default")))
#else
#define FW_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statuses ---- */

enum {
    FW_STATUS_OK = 0,        /* done */
    FW_STATUS_USAGE = 1,     /* wrong argument, option or order of calls */
    FW_STATUS_INPUT = 2,     /* the description or a pack is invalid; see the diagnostics */
    FW_STATUS_GEOMETRY = 3,  /* impossible geometry */
    FW_STATUS_IO = 4,        /* a file could not be read or written */
    FW_STATUS_NOMEM = 5,     /* over memory_cap (FW-D720), or out of memory (FW-D721) */
    FW_STATUS_LIMIT = 6,     /* another limit was reached */
    FW_STATUS_SOLVER = 7,    /* no numerical solution */
    FW_STATUS_CANCELLED = 8, /* fw_design_cancel was called */
    FW_STATUS_INTERNAL = 9   /* a fault of the library */
};

/* A few words for a status ("out of memory"); "unknown status" for other numbers. Static text. */
FW_API const char *fw_status_name(int status);

/* Version of the library that is linked, "MAJOR.MINOR.PATCH". Static text. */
FW_API const char *fw_library_version(void);

/* ---- options ---- */

/* Zero or NULL in a field means its default. Start from fw_design_options_default(): `size` tells
   the library which fields your header knew, so that fields can be added at the end. */
typedef struct fw_design_options {
    size_t size;                /* sizeof (fw_design_options) */
    const char *data_directory; /* holds processes/ and masks/; NULL: as installed */
    const char *flow;           /* only this process flow; NULL: all of the description */
    const char *scene;          /* for fw_design_simulate; NULL: the first */
    double accuracy;            /* relative error wanted on the peak hinge deflection, 1e-12..0.1;
                                   default 1e-3 */
    const char *effects;     /* "auto" (default), "all", "none" or a list "gravity,joint-damping" */
    const char *method;      /* how constraint forces are found; default "chain" */
    const char *integrator;  /* default "auto" */
    double rtol;             /* tolerance of the integrator, 1e-14..1e-2; default from accuracy */
    int32_t samples;         /* rows of the motion, 2..1000000; default 1001 */
    int32_t force;           /* not 0: masks and recipes of a rejected design too, each marked */
    double mask_tolerance_m; /* largest distance of an arc from its polygon, 0.36e-9..1e-6 m;
                                default 5e-9 */
    size_t memory_cap;       /* most bytes that one design holds; default 512 MiB */
    const char *stabilise;   /* "projection" (default), "baumgarte" or "none" */
    const char *at;          /* for fw_design_modes: about "rest" (default) or "equilibrium" */
    int32_t path;            /* not 0: fw_design_statics follows the load path */
    /* for fw_design_assemble: independent coordinates "AB.phi,BC.phi" (default: chosen by
       pivoting), their rates "10 rad/s,0 rad/s" and accelerations; default 0 */
    const char *independent, *rates, *accelerations;
    const char *corners; /* "auto" (default): the verdict holds at the corners of each flow, too;
                            "none": for the drawn geometry only */
    /* How flexures enter the mechanism, by a name of the program's table of hinge models (`flexwright
       simulate --help` prints it with what each is, tests/unit/cli compares): "auto" (default, by
       accuracy), "revolute", "compliance" or "elastica" */
    const char *hinge_model;
    const char *mask_formats; /* "gds,svg" (default), with oasis, dxf and stl where named, or
                                 "all"; GDSII and KLayout's files are always written */
    int32_t mask_vertices;    /* most of one GDSII boundary: 199, 4094 (default) or 8190; larger
                                 outlines are cut at vertices */
    const char *mask_flatten; /* "inside" (default): vertices on the arcs; "equal-area": chords
                                 that enclose the area of the arc */
    /* of the schedules */
    int32_t wafers, operators; /* 1..50; default 1 */
    const char *day; /* working day, default "08:00-18:00"; "08:00-12:00,13:00-18:00" with a
                                   break; "none": round the clock; "... from 2026-11-23": first day */
    const char *planning_times; /* times for steps whose own is not computable:
                                   "S03=90 min,S09=20 s"; marked in the schedule */
    const char *laboratory; /* files of laboratory packs, commas between: their values replace those
                               of the process packs by id, and every one is named */
    const char *cut; /* where recipes cut the wafer open: "x1,y1,x2,y2" (um, or lengths with unit)
                        or "flexure:ID"; default: radially through the narrowest gap of a hinge */
    const char *advice; /* "auto" (default): for a design that is not accepted, changes that would
                           be are looked for, each one run; "none": the verdict only */
    /* For fw_design_simulate with a stated rtol. Not 0: the largest forces and travels of joints
       and the errors of all peaks are found with the motion, as FW_DOCUMENT_SIMULATE_JSON, _TEXT
       and FW_DOCUMENT_PREVIEW_JSON print them. 0 (default): not before one of these is asked for,
       which then runs the scene again, to the same bits, and may fail or be cancelled as that call.
       The motion's own tables need neither. Without rtol these figures are what the tolerance is
       chosen by, and always found. */
    int32_t figures;
    /* Which measurement narrows the verdict's bands and the steps' time windows most. "auto" (default):
       after fw_design_judge where what a flow makes is undecided and advice is sought; to first order,
       which costs little, where recipes or the report are written. "all": bands after fw_design_judge in any case,
       some ten devices more a flow. "none" */
    const char *measurements;
    /* file with the laboratory's own layer numbers and names, a line for each layer: "structure 7/0
       name POLY2"; default: those of the layer tables */
    const char *layers;
    const char *directory; /* for fw_design_read_memory: where the drawings lie that the description
                              names; default: none are opened */
    int32_t
        jobs; /* threads that judge: flows and what each may make, 1..256; default 1. The results
                     are the same for any number; each takes memory of its own while it works */
} fw_design_options;

/* Fills `size` bytes (as the caller's header defines the struct) with the defaults. NULL options:
   does nothing. Use fw_design_options_default(). */
FW_API void fw_design_options_init(fw_design_options *options, size_t size);

static inline fw_design_options fw_design_options_default(void) {
    fw_design_options options;
    fw_design_options_init(&options, sizeof options);
    return options;
}

/* ---- a design ---- */

typedef struct fw_design fw_design;

/* A design without a description. NULL options: all defaults. NULL: out of memory. An option out of
   range is reported by fw_design_read with FW_STATUS_USAGE and a diagnostic. Free with
   fw_design_free. Cost: microseconds. */
FW_API fw_design *fw_design_new(const fw_design_options *options);

/* Frees the design and everything it handed out. NULL is allowed. */
FW_API void fw_design_free(fw_design *design);

/* Overrides a parameter ("arc", "250 deg") or an attribute ("flexure[A]/@length", "312 um") of the
   description that will be read. Call before fw_design_read; the order of calls is kept.
   FW_STATUS_USAGE, FW_STATUS_NOMEM; a wrong path or value is reported by fw_design_read. */
FW_API int fw_design_set(fw_design *design, const char *path, const char *value);

/* Reads the description (XML) at `path`, "-" for standard input, and the packs that it names, and
   checks both: all mistakes are in the diagnostics, each with its line and column. Once per design.
   FW_STATUS_INPUT, FW_STATUS_IO, FW_STATUS_USAGE, FW_STATUS_NOMEM. Cost: milliseconds. */
FW_API int fw_design_read(fw_design *design, const char *path);

/* The same from `n` bytes at `xml`; `name` stands for the file in diagnostics and in the manifest
   (NULL: "memory"). Drawings that it names are looked for in options.directory. */
FW_API int fw_design_read_memory(fw_design *design, const char *name, const void *xml, size_t n);

/* Name of the device; NULL before it was read. */
FW_API const char *fw_design_name(const fw_design *design);

/* Layout, mechanism, the motion of every scene, the required workspace and the verdict in every
   flow, with advice for a design that is not accepted; times and judgement of the flows. After
   reading. FW_STATUS_INPUT, FW_STATUS_USAGE (an effect that is not known), FW_STATUS_GEOMETRY,
   FW_STATUS_SOLVER, FW_STATUS_LIMIT, FW_STATUS_CANCELLED, FW_STATUS_NOMEM. Again after
   FW_STATUS_OK: does nothing. Cost for a six-bar: about 20 ms, 50 and more when advice is sought,
   and as much as some twenty verdicts more for every parameter. */
FW_API int fw_design_judge(fw_design *design);

/* The answer, as the exit status of the program: 0 accepted, 1 rejected (also when a flow cannot
   make the device), 4 inconclusive (the error band straddles
   the limit, or a scene may pull in or stays where it is not stable; after fw_design_fabricate
   also when dies of a <sweep> are); -1 before fw_design_judge.
   Masks that break rules count as what a flow cannot make; they are drawn while judging. */
FW_API int fw_design_decision(const fw_design *design);

/* Masks with each flow's bias, after judging. A rejected design gets none unless `force`: that is
   no error. Errors as fw_design_judge; again after FW_STATUS_OK: does nothing. Cost for a six-bar:
   about 50 ms for two flows. */
FW_API int fw_design_fabricate(fw_design *design);

/* Runs one scene (options.scene), after reading; judging is not needed. Errors as fw_design_judge,
   and FW_STATUS_INPUT when there is no such scene. Again after FW_STATUS_OK: does nothing. Cost for
   a six-bar: about 10 ms; with a stated rtol and without options.figures at most twice what its
   integration takes (docs/benchmarks.md). */
FW_API int fw_design_simulate(fw_design *design);

/* Small motions of the mechanism of one scene (options.scene, options.at), after reading: natural
   frequencies, damped eigenvalues, shapes. About rest a device without scenes will do. Errors as
   fw_design_simulate; FW_STATUS_SOLVER when there is no equilibrium. Again after FW_STATUS_OK: does
   nothing. Cost for a six-bar: a millisecond. */
FW_API int fw_design_modes(fw_design *design);

/* Equilibrium under the loads of one scene (options.scene), and with options.path the path of
   equilibria that leads there from rest, through limit points; after reading. Errors as
   fw_design_modes. Again after FW_STATUS_OK: does nothing. Cost for a six-bar: a millisecond, ten
   with the path. */
FW_API int fw_design_statics(fw_design *design);

/* Solves the position problem from the poses that the description states, however bad a guess they
   are; with rates, velocities, accelerations and joint forces under the loads of options.scene too
   (default: the first scene; none is needed). After reading. FW_STATUS_SOLVER when the joints
   cannot be closed: the diagnostics name the one that stays open and by how much, and
   FW_DOCUMENT_ASSEMBLE_SVG shows the least mismatch. FW_STATUS_USAGE for independent coordinates or
   rates that do not fit. Other errors as fw_design_simulate. Cost for a six-bar: about 5 ms. */
FW_API int fw_design_assemble(fw_design *design);

/* 1 where a message of what was computed says that the result is not to be relied on: the motion or
   equilibrium is of another start than the stated one (poses that were far from closing, initial
   velocities that the joints forbid), or the energy of a motion does not add up. Else 0. The
   commands then end with 4. */
FW_API int fw_design_unreliable(const fw_design *design);

/* The set of platform poses of a <six-bar> that the elastic limits leave, in every flow: volume,
   areas at constant rotation, extents, singular poses; and the required boxes, proved by interval
   arithmetic where that can be. After reading. FW_STATUS_INPUT where the mechanism is no <six-bar>;
   other errors as fw_design_judge. Again after FW_STATUS_OK: does nothing. Cost: about 0.2 s per
   flow. */
FW_API int fw_design_workspace(fw_design *design);

/* What accuracy costs: one scene (options.scene) by every method, integrator and tolerance against
   two far tighter runs, what the model itself is off by, what masks cost. budget_s: how much work
   to spend, 1..3600 s of a machine that does 2.5e9 instructions a second; 0: 20. times not 0:
   measure CPU time; without, the same input gives the same bytes. Costs are those of a model here;
   the program counts instructions. After reading. Errors as fw_design_simulate, and FW_STATUS_INPUT
   where nothing turns. Again after FW_STATUS_OK: does nothing. */
FW_API int fw_design_tradeoff(fw_design *design, double budget_s, int times);

enum {                        /* what fw_design_write writes, added up, with a manifest.json */
       FW_DESIGN_VERDICT = 1, /* verdict.json */
       FW_DESIGN_MASKS = 2,   /* masks/FLOW.gds, .svg, .lyp, .lyt, .json, .order.json, .order.txt,
                                 and options.mask_formats */
       FW_DESIGN_RECIPES = 4, /* recipes/FLOW.html, .csv, .ics, .json, .schedule.json,
                                 .schedule.csv, .schedule.svg */
       FW_DESIGN_MOTION = 8,  /* motion/SCENE.csv, .svg */
       FW_DESIGN_REPORT = 16, /* report.html, device.svg, device.png */
       FW_DESIGN_EVERYTHING = 31
};

/* Writes the results below `directory`, which appears complete or not at all. An earlier result
   there is replaced; a directory that holds something else is refused (FW_STATUS_IO). After
   judging, and for masks and recipes after fw_design_fabricate. FW_STATUS_IO, FW_STATUS_NOMEM,
   FW_STATUS_USAGE (also for bits not named above). */
FW_API int fw_design_write(fw_design *design, const char *directory, unsigned what);
/* Files that the last fw_design_write made, manifest.json not counted. 0: there was nothing to
   write (masks of a rejected design) and `directory` was left as it was. NULL gives 0. */
FW_API int fw_design_files_written(const fw_design *design);

/* ---- documents ---- */

enum {                                    /* what it is; what must have been called */
       FW_DOCUMENT_VERDICT_JSON = 0,      /* schema flexwright.verdict/1; judge */
       FW_DOCUMENT_VERDICT_TEXT = 1,      /* for a terminal; judge */
       FW_DOCUMENT_SIMULATE_JSON = 2,     /* schema flexwright.simulate/1; simulate */
       FW_DOCUMENT_SIMULATE_TEXT = 3,     /* for a terminal; simulate */
       FW_DOCUMENT_MOTION_CSV = 4,        /* every body's motion, 17 digits; simulate */
       FW_DOCUMENT_ANIMATION_SVG = 5,     /* plays by itself; simulate */
       FW_DOCUMENT_MASKS_JSON = 6,        /* certificates, schema flexwright.masks/1; fabricate */
       FW_DOCUMENT_RECIPES_JSON = 7,      /* of one flow, or flexwright.recipes/1; fabricate */
       FW_DOCUMENT_DEVICE_SVG = 8,        /* the drawing, hinges coloured by utilisation; judge */
       FW_DOCUMENT_REPORT_HTML = 9,       /* everything on one page; judge */
       FW_DOCUMENT_DIAGNOSTICS_TEXT = 10, /* one line each with a caret below its place; nothing */
       FW_DOCUMENT_MODES_JSON = 11,       /* schema flexwright.modes/1; modes */
       FW_DOCUMENT_MODES_TEXT = 12,       /* for a terminal; modes */
       FW_DOCUMENT_MODES_SVG = 13,        /* the first twelve shapes, moving; modes */
       FW_DOCUMENT_STATICS_JSON = 14,     /* schema flexwright.statics/1; statics */
       FW_DOCUMENT_STATICS_TEXT = 15,     /* for a terminal; statics */
       FW_DOCUMENT_STATICS_SVG = 16,    /* the equilibrium over rest; moving with a path; statics */
       FW_DOCUMENT_LOAD_PATH_CSV = 17,  /* a row per point, or the equilibrium alone; statics */
       FW_DOCUMENT_LOAD_PATH_SVG = 18,  /* load against displacement; statics with options.path */
       FW_DOCUMENT_ASSEMBLE_JSON = 19,  /* schema flexwright.assemble/1; assemble */
       FW_DOCUMENT_ASSEMBLE_TEXT = 20,  /* for a terminal; assemble */
       FW_DOCUMENT_ASSEMBLE_SVG = 21,   /* before and after; assemble, also when it failed */
       FW_DOCUMENT_FORCES_CSV = 22,     /* accelerations and joint forces, 17 digits; simulate */
       FW_DOCUMENT_WORKSPACE_JSON = 23, /* schema flexwright.workspace/1; workspace */
       FW_DOCUMENT_WORKSPACE_TEXT = 24, /* for a terminal; workspace */
       FW_DOCUMENT_WORKSPACE_SVG = 25,  /* slices at constant rotation; workspace */
       /* proofs of the required boxes, to be verified by other programs: schema
          flexwright.workspace-certificate/2; workspace */
       FW_DOCUMENT_CERTIFICATE_JSON = 26,
       /* elements and attributes of descriptions, methods, integrators, effects and so on, for
          forms and editors: schema flexwright.table/1; nothing */
       FW_DOCUMENT_TABLE_JSON = 27,
       /* for an interactive page: the mechanism's shapes, and motion and verdict where they were
          computed, rounded to what a picture needs: schema flexwright.preview/1; read */
       FW_DOCUMENT_PREVIEW_JSON = 28,
       FW_DOCUMENT_TRADEOFF_JSON = 29, /* schema flexwright.tradeoff/1; tradeoff */
       FW_DOCUMENT_TRADEOFF_TEXT = 30, /* for a terminal; tradeoff */
       FW_DOCUMENT_TRADEOFF_CSV = 31,  /* the same numbers; tradeoff */
       FW_DOCUMENT_TRADEOFF_SVG = 32,  /* work-precision, model, masks; tradeoff */
       /* all diagnostics so far, for editors: schema flexwright.diagnostics/1; nothing */
       FW_DOCUMENT_DIAGNOSTICS_JSON = 33
};

/* One document as UTF-8 text, NUL-terminated; `length` (may be NULL) without the NUL. The text
   belongs to the design. Composed at the first call, the same pointer afterwards until a later
   stage changes it (the old text stays valid); diagnostics are composed anew each time. On error
   *text is NULL. FW_STATUS_USAGE for an unknown document or one whose stage was not called,
   FW_STATUS_NOMEM. */
FW_API int fw_design_document(fw_design *design, int document, const char **text, size_t *length);

/* The same into a file that appears whole or not at all; "-" is standard output. FW_STATUS_IO too.
 */
FW_API int fw_design_save(fw_design *design, int document, const char *path);

enum { FW_DETAIL_QUIET = -1, FW_DETAIL_NORMAL = 0, FW_DETAIL_VERBOSE = 1 };

/* How the ..._TEXT documents are made from now on. detail: of the verdict, and which diagnostics
   (quiet: errors; normal: warnings too; verbose: notes too). colour: not 0 for terminal colours.
   FW_STATUS_USAGE. */
FW_API int fw_design_text_style(fw_design *design, int detail, int colour);

/* ---- diagnostics ---- */

enum { FW_SEVERITY_NOTE = 0, FW_SEVERITY_WARNING = 1, FW_SEVERITY_ERROR = 2 };

typedef struct fw_diagnostic {
    int32_t number;      /* FW-Dnnn; `flexwright explain` has the long text */
    int32_t severity;    /* FW_SEVERITY_... */
    const char *file;    /* NULL: not about a file */
    int32_t line;        /* from 1; 0: the file as a whole */
    int32_t column;      /* in bytes, from 1; 0: the line as a whole */
    const char *message; /* what is wrong, the limit and its source, what to do */
    /* errno of the call of the system that failed (ENOENT: there is no such file), of an error of a file; 0: none did */
    int32_t system_error;
} fw_diagnostic;

/* How many there are so far; 0 for NULL. At most 100 are kept: of one call the first, errors before warnings and notes. Where
   they are full, errors of earlier calls make room for what a later one says, the oldest first. */
FW_API size_t fw_design_diagnostics(const fw_design *design);

/* How many of them were said before the latest call that answers with a status began: those from this number on are what
   that call said. 0 for NULL. */
FW_API size_t fw_design_diagnostics_before(const fw_design *design);

/* The i-th in the order in which they were found; NULL beyond the last. Belongs to the design;
   fields may be added at the end. */
FW_API const fw_diagnostic *fw_design_diagnostic(fw_design *design, size_t i);

/* ---- cancelling ---- */

/* Asks the work to stop; the running call returns FW_STATUS_CANCELLED soon (integration looks at it
   at each step), and so does every later call until fw_design_cancel_clear. Other designs are not
   touched. Async-signal-safe, and callable from any thread while the design is at work, but not
   while or after it is freed. NULL is allowed. */
FW_API void fw_design_cancel(fw_design *design);

/* Takes the request back; call it before work after a cancel. Async-signal-safe. */
FW_API void fw_design_cancel_clear(fw_design *design);

/* ---- progress ---- */

/* Called in the thread of the call that works: at most 64 times a motion, else once a step of the work.
   what: what is being done ("judging the device as drawn"; static text). done of `of`: s of the scene,
   flows, devices, as `unit` says; `of` 0: not known how many; below 0: at most -of, for a search that
   usually ends before. Not 0 as the answer: as fw_design_cancel.
   It must not call into the same design, but fw_design_cancel. */
typedef int fw_progress_told(void *context, const char *what, double done, double of,
                             const char *unit);

/* told NULL: nobody is told (default). What is computed does not change by it, to the last bit. */
FW_API int fw_design_progress(fw_design *design, fw_progress_told *told, void *context);

/* ---- numbers ---- */

enum {                       /* of which type the values of an array are */
       FW_ARRAY_REAL = 0,    /* double; NaN: not known, or there is none */
       FW_ARRAY_WHOLE = 1,   /* int32_t */
       FW_ARRAY_TEXT = 2,    /* const char *, UTF-8; NULL: none */
       FW_ARRAY_COMPLEX = 3, /* two doubles, real and imaginary part */
       FW_ARRAY_TRUTH = 4    /* int32_t, 0 or 1; -1: not known */
};

/* A table of values in C order (the last index runs fastest), without gaps. It belongs to the design,
   with all that it points to, and stays as it is until fw_design_free. */
typedef struct fw_array {
    const char *name;
    /* SI: "rad", "m/s"; "1": a pure number; "": text. "m,m,rad": of the values along the last axis, one
       each. "*": each has its own, in the array "unit", or NAME_unit beside NAME */
    const char *unit;
    const char *about;           /* a sentence */
    int32_t type;                /* FW_ARRAY_... */
    int32_t dimensions;          /* 1..3 */
    size_t extent[3];            /* of each; 1 beyond them */
    const void *data;            /* (extent[0] x extent[1] x extent[2]); not NULL */
    const char *const *label[3]; /* (extent[i]) what an index stands for, ids of bodies or hinges;
                                    NULL: nothing but its number */
} fw_array;

enum {                              /* sets of arrays; what must have been called */
       FW_NUMBERS_PARAMETERS = 0,   /* a row per <parameter>; read */
       FW_NUMBERS_SCENES = 1,       /* a row per <scene>; read */
       FW_NUMBERS_HINGES = 2,       /* a row per hinge: worst of the flows; drawn, made; judge */
       FW_NUMBERS_FLOW_HINGES = 3,  /* a row per flow and hinge; judge */
       FW_NUMBERS_FLOWS = 4,        /* a row per flow; judge */
       FW_NUMBERS_GOVERNING = 5,    /* what decides: as made, as drawn; judge */
       FW_NUMBERS_CLEARANCES = 6,   /* a row per scene or required box, and flow; judge */
       FW_NUMBERS_REQUIREMENTS = 7, /* a row per requirement, scene and flow; judge */
       FW_NUMBERS_PROBES = 8,       /* a row per probe, scene and flow; judge */
       FW_NUMBERS_MOTION = 9,       /* time, coordinates, angles, forces, probes by row; simulate */
       FW_NUMBERS_PEAKS = 10,       /* a row per joint: its largest angle; simulate */
       FW_NUMBERS_MOTION_PROBES = 11, /* a row per probe: its extremes; simulate */
       FW_NUMBERS_MODES = 12,         /* frequencies, eigenvalues, shapes; modes */
       FW_NUMBERS_STATICS = 13,       /* pose, angles, forces of the equilibrium; statics */
       FW_NUMBERS_LOAD_PATH = 14, /* a row per equilibrium; statics, without options.path none */
       FW_NUMBERS_ASSEMBLY = 15,  /* poses before and after, forces; assemble */
       FW_NUMBERS_WORKSPACE = 16  /* a row per flow: volume, extents, limits; workspace */
};

/* How many arrays a set has; *count (may be NULL) is 0 on error. FW_STATUS_USAGE for an unknown set or one whose stage was not called,
   FW_STATUS_NOMEM. The first call copies the values into tables, later ones cost nothing; those of a
   motion of N rows and B bodies take 80 N B bytes and more. docs/c-api.md lists the arrays. */
FW_API int fw_design_arrays(fw_design *design, int numbers, size_t *count);

/* The i-th of them, or the one of that name; NULL: there is none, or what fw_design_arrays would
   answer with another status than FW_STATUS_OK. Asked for again after a later stage it may be another
   table; the former stays valid. */
FW_API const fw_array *fw_design_array(fw_design *design, int numbers, size_t i);
FW_API const fw_array *fw_design_array_named(fw_design *design, int numbers, const char *name);

/* ---- studies ---- */

typedef struct fw_study_settings { /* zero or NULL in a field means its default */
    size_t size;                   /* sizeof (fw_study_settings) */
    const char *study;             /* which <study> of a device file; NULL: the only one */
    const char *directory;         /* of the samples (study.sqlite) and the results; needed */
    int32_t jobs;                  /* threads, 1..256; 0: one for each processor */
    int32_t shard, shards;         /* every shards-th sample from the shard-th on; 0, 0: all */
    int32_t resume;                /* not 0: go on with the samples that are there */
} fw_study_settings;

/* Runs a study: `file` is a device file with a <study>, or a study file. Every device has the options of
   this design and the settings of fw_design_set, and the study's own behind them; the design itself need not
   be read, and is not changed but for its diagnostics. Samples are kept as they come, so that a cancelled study
   can go on (resume). *json (may be NULL): schema flexwright.study/1, of the design; NULL for a shard.
   fw_design_progress is told of devices. FW_STATUS_INPUT, FW_STATUS_IO, FW_STATUS_CANCELLED,
   FW_STATUS_NOMEM, FW_STATUS_USAGE. Cost: that of the devices. */
FW_API int fw_design_study(fw_design *design, const char *file, const fw_study_settings *settings,
                           const char **json, size_t *length);

#ifdef __cplusplus
}
#endif
#endif
