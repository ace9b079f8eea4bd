/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One row of tests/data/hinge/root_strain.csv on standard input: half of its strip as an input deck
   of CalculiX, NAME.inp, and the lattice of its two edges, NAME.edges.

     solid_half NAME MESH LAYERS      MESH 1: 12 elements along a fillet, 2: 16, and through half
   the width one or two more than the product's mesh; LAYERS: how many more through half the depth

   From the first root's block to the middle section, which stays plane and is turned by 1 N m (the
   half depth by half of it) about the wafer's normal, free to move and to change its width. um, uN,
   MPa. Cost: some ms, the solver's some seconds. tools/solids/README.md */
#include "continuum/solver.h"
#include "geometry/contour.h"
#include "row.h"
#include <stdlib.h>

/* micrometres per radian of the reference node's displacement that stands for the rotation */
static const double rotation_um = 10;

static void number(fw_text *deck, const char *before, double value) {
    fw_text_add(deck, before);
    fw_continuum_deck_number(deck, value);
}

static int node_at(const fw_continuum_mesh *m, int i, int j, int k) {
    return m->number[fw_continuum_lattice(m, i, j, k)];
}

static double flat_um(const fw_continuum_mesh *m, const double *of, int i, int j) {
    return 1e6 * of[(size_t)i * (size_t)(2 * m->nj + 1) + (size_t)j];
}

/* the lattice runs along first: its first half is the mesh with half of ni */
static fw_continuum_mesh half_of(const fw_continuum_mesh *whole) {
    fw_continuum_mesh m = *whole;
    m.ni /= 2, m.nnode = 0, m.nelement = m.ni * m.nj * m.nk;
    for (int j = 0; j <= 2 * m.nj; j++)
        for (int k = 0; k <= 2 * m.nk; k++) {
            int n = node_at(&m, 2 * m.ni, j, k);
            if (n > m.nnode) m.nnode = n;
        }
    return m;
}

/* Widths that vary as those of the program's strips do: every place across is moved in proportion,
   the edge by as much as the strip's is beside that of one width; fillets go with it */
static void vary(const solid_row *row, fw_continuum_mesh *m) {
    double L = row->leaf ? row->size_m : row->size_m * row->angle_rad, t = row->width_m;
    const fw_geometry_strip_piece piece = {
        L, row->leaf ? 0 : 1 / row->size_m, {t, row->width_middle_m, t}};
    fw_geometry_strip_shape shape;
    fw_geometry_strip_shape_of(&piece, &shape);
    const size_t row_nodes = (size_t)(2 * m->nj + 1);
    for (int i = 0; i <= 2 * m->ni; i++) {
        double out[2], *x = m->x + (size_t)i * row_nodes, *y = m->y + (size_t)i * row_nodes;
        for (int side = 0; side < 2; side++) {
            size_t n = side ? row_nodes - 1 : 0;
            out[side] = row->leaf ? x[n] : hypot(x[n], y[n]) - row->size_m;
        }
        for (size_t j = 0; j < row_nodes; j++) {
            double b = row->leaf ? 0 : atan2(y[j], x[j]);
            double n = row->leaf ? x[j] : hypot(x[j], y[j]) - row->size_m;
            double s = row->leaf ? y[j] + 0.5 * L : row->size_m * (b + 0.5 * row->angle_rad);
            if (!(s > 0 && s < L)) continue;
            double more = 0.5 * (fw_geometry_strip_width(&shape, s) - t);
            double part = n / (n * out[0] > 0 ? fabs(out[0]) : fabs(out[1]));
            n += part * more - fw_geometry_strip_aside(&shape, s);
            x[j] = row->leaf ? n : (row->size_m + n) * cos(b);
            if (!row->leaf) y[j] = (row->size_m + n) * sin(b);
        }
    }
}

static fw_status mesh_of(fw_arena *arena, const solid_row *row, int fineness, int layers,
                         fw_continuum_mesh *half) {
    const fw_flexure_input in = row_input(row);
    const fw_continuum_finer finer = {.fillet = 4 * fineness, .across = fineness, .layers = layers};
    fw_continuum_shape shape;
    fw_continuum_mesh whole;
    const char *why = "";
    fw_continuum_shape_of(&in, &shape);
    fw_status status = fw_continuum_mesh_finer(arena, &shape, 1, false, finer, &whole, &why);
    if (status) fprintf(stderr, "no mesh: %s\n", why);
    FW_TRY(status);
    if (row->width_middle_m > 0) vary(row, &whole);
    if (fw_continuum_mesh_quality(&whole).least_jacobian < 0.02 || whole.ni % 2) {
        fprintf(stderr, "no mesh: bricks too skew\n");
        return FW_GEOMETRY;
    }
    *half = half_of(&whole);
    return FW_OK;
}

/* along the section u_y = w + rotation (x - x0): node, 2 to the reference node's 1 (w) and 2 */
static void turned_section(fw_text *deck, const fw_continuum_mesh *m, int reference) {
    int end = 2 * m->ni;
    double x0 = flat_um(m, m->x, end, m->nj);
    fw_text_add(deck, "*EQUATION\n");
    for (int j = 0; j <= 2 * m->nj; j++)
        for (int k = 0; k <= 2 * m->nk; k++) {
            int n = node_at(m, end, j, k);
            if (!n) continue;
            fw_text_printf(deck, "3\n%d,2,1.,%d,1,-1.,%d,2", n, reference, reference);
            number(deck, ",", -(flat_um(m, m->x, end, j) - x0) / rotation_um);
            fw_text_add(deck, "\n");
        }
}

static void held(fw_text *deck, const fw_continuum_mesh *m, int reference) {
    fw_text_add(deck, "*BOUNDARY\n");
    for (int i = 0; i <= 2 * m->ni; i++)
        for (int j = 0; j <= 2 * m->nj; j++)
            for (int k = 0; k <= 2 * m->nk; k++) {
                int n = node_at(m, i, j, k);
                if (!n) continue;
                if (fw_continuum_rigid(m, 0, i, j))
                    fw_text_printf(deck, "%d,1,3\n", n);
                else if (k == 0)
                    fw_text_printf(deck, "%d,3,3\n", n);
            }
    fw_text_printf(deck, "%d,3,3\n*NSET, NSET=EDGES\n", reference);
    for (int side = 0; side < 2; side++)
        for (int i = 2 * m->quiet; i <= 2 * m->ni; i++)
            for (int k = 0; k <= 2 * m->nk; k++) {
                int n = node_at(m, i, side ? 2 * m->nj : 0, k);
                if (n) fw_text_printf(deck, "%d,\n", n);
            }
}

static void deck_of(fw_text *deck, const solid_row *row, const fw_continuum_mesh *m) {
    int reference = m->nnode + 1;
    const fw_continuum_material material = {.cubic = row->silicon,
                                            .youngs_Pa = row_youngs_Pa,
                                            .poisson = row->poisson,
                                            .c11_Pa = row_silicon_Pa[0],
                                            .c12_Pa = row_silicon_Pa[1],
                                            .c44_Pa = row_silicon_Pa[2],
                                            .crystal_rad = -row->axis_rad};
    fw_continuum_deck_head(deck, "half of a strip");
    fw_text_add(deck, "*NODE, NSET=NALL\n");
    fw_continuum_deck_nodes(deck, m, (fw_geometry_pose){0, 0, 0}, 1);
    fw_text_printf(deck, "*NODE, NSET=NREF\n%d, 0, 0, 0\n*ELEMENT, TYPE=C3D20R, ELSET=EALL\n",
                   reference);
    fw_continuum_deck_bricks(deck, m, 1, 1);
    fw_continuum_deck_material(deck, &material, "M", "EALL", 0);
    turned_section(deck, m, reference);
    held(deck, m, reference);
    fw_text_printf(deck, "*STEP\n*STATIC, SOLVER=SPOOLES\n*CLOAD\n%d,2", reference);
    number(deck, ",", 0.5 * 1e6 / rotation_um);
    fw_text_add(deck, "\n*NODE PRINT, NSET=NREF\nU\n*NODE PRINT, NSET=EDGES\nU\n*END STEP\n");
}

/* first line: elements along, through half the depth and along the fillet, bricks, reference node,
   micrometres per radian; second: z; then for the right and the left edge, from the fillet's start
   to the middle section in half steps: x, y and the node (0: none) at every z */
static void edges_of(fw_text *out, const fw_continuum_mesh *m, int fineness) {
    int first = 2 * m->quiet;
    fw_text_printf(out, "%d %d %d %d %d", m->ni - m->quiet, m->nk, 8 + 4 * fineness, m->nelement,
                   m->nnode + 1);
    number(out, " ", rotation_um);
    fw_text_add(out, "\n");
    for (int k = 0; k <= 2 * m->nk; k++)
        number(out, k ? " " : "", 1e6 * m->z[k]);
    for (int side = 0; side < 2; side++)
        for (int i = first; i <= 2 * m->ni; i++) {
            int j = side ? 2 * m->nj : 0;
            fw_text_add(out, "\n");
            fw_text_number(out, flat_um(m, m->x, i, j), 15);
            fw_text_add(out, " ");
            fw_text_number(out, flat_um(m, m->y, i, j), 15);
            for (int k = 0; k <= 2 * m->nk; k++)
                fw_text_printf(out, " %d", node_at(m, i, j, k));
        }
    fw_text_add(out, "\n");
}

static fw_status keep(const char *name, const char *ending, const fw_text *text) {
    char path[600];
    FW_TRY(fw_text_end(text));
    snprintf(path, sizeof path, "%s.%s", name, ending);
    FILE *file = fopen(path, "w");
    if (!file) return FW_IO;
    size_t n = fwrite(text->data, 1, text->length, file);
    return fclose(file) || n != text->length ? FW_IO : FW_OK;
}

static fw_status run(fw_arena *arena, const char *name, int fineness, int layers) {
    char line[300];
    solid_row row;
    fw_continuum_mesh half;
    fw_text deck = fw_text_new(arena), edges = fw_text_new(arena);
    if (!fgets(line, sizeof line, stdin) || !row_of(line, &row)) return FW_USAGE;
    FW_TRY(mesh_of(arena, &row, fineness, layers, &half));
    deck_of(&deck, &row, &half);
    edges_of(&edges, &half, fineness);
    FW_TRY(keep(name, "inp", &deck));
    return keep(name, "edges", &edges);
}

int main(int argc, char **argv) {
    int fineness = argc == 4 ? atoi(argv[2]) : 0, layers = argc == 4 ? atoi(argv[3]) : 0;
    if (fineness < 1 || fineness > 4 || layers < 0 || layers > 8) {
        fprintf(stderr, "usage: solid_half NAME MESH LAYERS, with a row on standard input\n");
        return 2;
    }
    fw_arena *arena = fw_arena_new((size_t)1 << 30);
    fw_status status = arena ? run(arena, argv[1], fineness, layers) : FW_NOMEM;
    fw_arena_free(arena);
    return status != FW_OK;
}
