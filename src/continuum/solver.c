/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/solver.h"
#include "base/output.h"
#include "continuum/external.h"
#include <math.h>

const char *const fw_continuum_install =
    "CalculiX is not installed (program ccx): on Debian, apt install calculix-ccx";

enum { MOST_BYTES = 400 << 20 };

static fw_status bad_shape(fw_diags *diags, fw_place place, const char *why) {
    fw_diag_error(diags, 213, place, "the flexure cannot be meshed: %s", why);
    return FW_GEOMETRY;
}

fw_status fw_continuum_usable(const fw_continuum_material *m, double refinement, fw_place place,
                              fw_diags *diags) {
    bool good = m->cubic ? m->c44_Pa > 0.0 && m->c11_Pa > fabs(m->c12_Pa) &&
                               m->c11_Pa + 2.0 * m->c12_Pa > 0.0 && isfinite(m->crystal_rad)
                         : m->youngs_Pa > 0.0 && m->poisson > -1.0 && m->poisson < 0.5;
    if (!good) return bad_shape(diags, place, "the elastic constants are not those of a solid");
    if (refinement == 0.0 || (refinement >= 0.5 && refinement <= 4.0)) return FW_OK;
    return bad_shape(diags, place, "the refinement is not between 0.5 and 4");
}

fw_status fw_continuum_good_mesh(fw_arena *arena, const fw_continuum_shape *shape,
                                 double refinement, bool plane_stress, fw_place place,
                                 fw_diags *diags, fw_continuum_mesh *mesh) {
    const char *why = "";
    fw_status status = fw_continuum_mesh_build(arena, shape, refinement, plane_stress, mesh, &why);
    if (status == FW_GEOMETRY) return bad_shape(diags, place, why);
    FW_TRY(status);
    if (fw_continuum_mesh_quality(mesh).least_jacobian > 0.02) return FW_OK;
    return bad_shape(diags, place,
                     "bricks would fold over at the root; the fillet is too small or too large for "
                     "the width, or the curve too tight");
}

static fw_status failed(const fw_continuum_solver_call *call, double timeout_s,
                        const fw_continuum_external_run *run, fw_diags *diags) {
    char limit[32];
    if (run->end == FW_EXTERNAL_CANCELLED) return FW_CANCELLED;
    if (run->end == FW_EXTERNAL_TIMEOUT) {
        fw_diag_error(diags, 215, call->place,
                      "CalculiX was ended after %s s; refine less, or allow more time",
                      fw_number_text(limit, sizeof limit, timeout_s, 4));
        return FW_LIMIT;
    }
    fw_diag_error(diags, 215, call->place,
                  "CalculiX ended with %s %d; run the written deck by hand to see its messages",
                  run->code < 0 ? "signal" : "status", run->code < 0 ? -run->code : run->code);
    return FW_SOLVER;
}

static fw_status read_back(fw_arena *arena, const fw_continuum_external_room *room,
                           const char *name, fw_diags *diags, char **text) {
    size_t n;
    const char *file = fw_arena_printf(arena, "%s/%s", room->path, name);
    FW_NEED(file);
    return fw_input_read(arena, file, MOST_BYTES, diags, text, &n);
}

static fw_status run_in(fw_arena *arena, const fw_continuum_solver_call *call,
                        const fw_continuum_external_room *room, fw_diags *diags,
                        fw_continuum_solver_result *out) {
    const char *argv[] = {call->program, "job", NULL};
    double timeout_s = call->timeout_s > 0.0 ? call->timeout_s : 600.0;
    fw_continuum_external_run run;
    int fields = 0;
    char *text;
    FW_TRY(fw_continuum_external_write(room, "job.inp", call->deck->data, call->deck->length));
    FW_TRY(fw_continuum_external_call(room, argv, "log.txt", timeout_s, &run));
    out->cpu_s = run.cpu_s;
    if (run.end != FW_EXTERNAL_DONE) return failed(call, timeout_s, &run, diags);
    FW_TRY(read_back(arena, room, "job.dat", diags, &text));
    fw_status status =
        fw_continuum_results_print(text, call->node, call->nnode, out->step, call->nstep);
    if (status == FW_OK) {
        FW_TRY(read_back(arena, room, "job.frd", diags, &text));
        status = fw_continuum_results_fields(text, out->strain, out->stress, call->nstep, &fields);
    }
    for (int i = 0; i < call->nstep && status == FW_OK; i++)
        for (int k = 0; k < call->nnode; k++)
            if (!out->step[i].have_move[k]) status = FW_SOLVER;
    if (status == FW_OK && fields < call->nstep) status = FW_SOLVER;
    if (status == FW_SOLVER)
        fw_diag_error(diags, 216, call->place,
                      "CalculiX ended without an error, but its results are incomplete: it did not "
                      "converge, or it writes another format than version 2.20");
    return status;
}

fw_status fw_continuum_solver_run(fw_arena *arena, const fw_continuum_solver_call *call,
                                  fw_diags *diags, fw_continuum_solver_result *result) {
    fw_continuum_external_room room;
    *result = (fw_continuum_solver_result){.cpu_s = 0.0};
    if (call->nstep > FW_RESULT_STEPS || call->nnode > FW_RESULT_NODES) return FW_LIMIT;
    FW_TRY(fw_text_end(call->deck));
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    if (fw_continuum_external_room_open(arena, &room) != FW_OK) {
        fw_diag_error(diags, 215, call->place,
                      "no private directory could be made below TMPDIR or /tmp");
        return FW_IO;
    }
    fw_status status = run_in(arena, call, &room, diags, result);
    fw_continuum_external_room_close(&room);
    if (status == FW_IO)
        fw_diag_error(diags, 215, call->place,
                      "CalculiX could not be started, or the disk is full");
    return status;
}
