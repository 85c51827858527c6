/* Calls the functions for constraints, cells, relaxations and surfaces with good and bad arguments. */
#include "expect.h"

/* A frame around a hole. */
static const int32_t FRAME[][2] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 6}};
static const uint32_t RINGS[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};

static void constraints_bound_a_domain(void) {
    incircle_mesh *mesh;
    incircle_constrained *made;
    const int32_t hole[2] = {4, 4}, outside[2] = {20, 20};
    uint32_t triangles[16][3], pieces[8][2], list[16];
    size_t count, starts[9];
    incircle_plan plan = {.size = sizeof plan, .constraints = RINGS, .constraint_count = 8};
    IS(incircle_triangulate(FRAME, 8, INCIRCLE_I32, NULL, &mesh), INCIRCLE_OK);
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_OK);
    IS(incircle_constrained_triangles(made, triangles, 16, &count), INCIRCLE_OK);
    TRUE(count == 10);
    incircle_constrained_free(made);
    plan.domain = INCIRCLE_HOLES;
    plan.holes = hole;
    plan.hole_count = 1;
    const int32_t place[2] = {1, 2};
    plan.regions = place;
    plan.region_count = 1;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_OK);
    IS(incircle_constrained_triangles(made, triangles, 7, &count), INCIRCLE_BUFFER);
    IS(incircle_constrained_triangles(made, triangles, 16, &count), INCIRCLE_OK);
    TRUE(count == 8);
    IS(incircle_constrained_regions(made, list, 16, &count), INCIRCLE_OK);
    TRUE(count == 8 && list[0] == 0 && list[7] == 0);
    IS(incircle_constrained_marked(made, list, 16, &count), INCIRCLE_OK);
    TRUE(count == 1 && list[0] == 0);
    IS(incircle_constrained_pieces(made, pieces, 8, &count), INCIRCLE_OK);
    TRUE(count == 8 && pieces[0][0] == 0 && pieces[0][1] == 1 && pieces[7][1] == 7);
    IS(incircle_constrained_piece_starts(made, starts, 9, &count), INCIRCLE_OK);
    TRUE(count == 9 && starts[8] == 8);
    IS(incircle_constrained_piece_constraints(made, list, 16, &count), INCIRCLE_OK);
    TRUE(count == 8 && list[0] == 0 && list[1] == 3);
    IS(incircle_constrained_verify(made, mesh, &plan), INCIRCLE_OK);
    plan.domain = INCIRCLE_ALL;
    IS(incircle_constrained_verify(made, mesh, &plan), INCIRCLE_WRONG_MESH);
    IS(incircle_constrained_verify(made, NULL, &plan), INCIRCLE_ARGUMENT);
    IS(incircle_constrained_verify(made, mesh, NULL), INCIRCLE_ARGUMENT);
    incircle_constrained_free(made);
    plan.domain = INCIRCLE_HOLES;
    plan.holes = outside;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_INPUT);
    says("lies outside the hull");
    TRUE(made == NULL);
    plan.holes = NULL;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_ARGUMENT);
    plan = (incircle_plan){.size = sizeof plan, .constraints = RINGS, .constraint_count = 8, .domain = 4};
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_ARGUMENT);
    says("4 is not the number of a domain");
    plan.domain = INCIRCLE_EVEN_ODD;
    plan.lines = 9;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_CHOICE);
    plan.lines = 1;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_INPUT);
    says("is not closed");
    const uint32_t wrong[][2] = {{0, 8}}, crossed[][2] = {{0, 2}, {1, 3}};
    plan = (incircle_plan){.size = sizeof plan, .constraints = wrong, .constraint_count = 1};
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_INPUT);
    says("constraint 0 names point 8, but the number of points is 8");
    plan.constraints = crossed;
    plan.constraint_count = 2;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_INPUT);
    plan.constraints = NULL;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_ARGUMENT);
    plan.size = 0;
    IS(incircle_constrain(mesh, &plan, &made), INCIRCLE_ARGUMENT);
    says("the plan has 0 bytes");
    IS(incircle_constrain(mesh, NULL, &made), INCIRCLE_ARGUMENT);
    IS(incircle_constrain(NULL, &plan, &made), INCIRCLE_ARGUMENT);
    IS(incircle_constrain(mesh, &plan, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_constrained_triangles(NULL, NULL, 0, &count), INCIRCLE_ARGUMENT);
    IS(incircle_constrained_pieces(NULL, NULL, 0, &count), INCIRCLE_ARGUMENT);
    incircle_constrained_free(NULL);
    incircle_mesh_free(mesh);
}

static void points_and_constraints_are_one_job(void) {
    const int32_t hole[2] = {4, 4};
    static const int32_t twice[][2] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 6}, {9, 9}};
    incircle_mesh *mesh;
    incircle_constrained *made, *steps;
    uint32_t triangles[16][3], again[16][3], hull[8], duplicates[2][2];
    size_t count, other;
    incircle_plan plan = {.size = sizeof plan, .constraints = RINGS, .constraint_count = 8, .domain = INCIRCLE_HOLES};
    plan.holes = hole;
    plan.hole_count = 1;
    incircle_options options = {.size = sizeof options, .threads = 1};
    IS(incircle_triangulate(twice, 9, INCIRCLE_I32, NULL, &mesh), INCIRCLE_OK);
    for (uint32_t domain = INCIRCLE_ALL; domain <= INCIRCLE_EVEN_ODD; ++domain) {
        plan.domain = domain;
        plan.hole_count = domain == INCIRCLE_HOLES;
        IS(incircle_constrain(mesh, &plan, &steps), INCIRCLE_OK);
        IS(incircle_triangulate_constrained(twice, 9, INCIRCLE_I32, &options, &plan, &made), INCIRCLE_OK);
        IS(incircle_constrained_triangles(made, triangles, 16, &count), INCIRCLE_OK);
        IS(incircle_constrained_triangles(steps, again, 16, &other), INCIRCLE_OK);
        TRUE(count == other && count >= 8 && memcmp(triangles, again, count * sizeof *triangles) == 0);
        IS(incircle_constrained_verify(made, NULL, &plan), INCIRCLE_OK);
        IS(incircle_constrained_verify(made, mesh, &plan), INCIRCLE_OK);
        IS(incircle_constrained_verify(steps, NULL, &plan), INCIRCLE_ARGUMENT);
        IS(incircle_constrained_hull(made, hull, 8, &count), INCIRCLE_OK);
        TRUE(count == 4 && hull[0] == 0 && hull[3] == 3);
        IS(incircle_constrained_hull(steps, hull, 8, &count), INCIRCLE_CHOICE);
        says("ask incircle_mesh_hull");
        IS(incircle_constrained_duplicates(made, duplicates, 2, &count), INCIRCLE_OK);
        TRUE(count == 1 && duplicates[0][0] == 8 && duplicates[0][1] == 2);
        IS(incircle_constrained_duplicates(steps, duplicates, 2, &count), INCIRCLE_CHOICE);
        incircle_constrained_free(made);
        incircle_constrained_free(steps);
    }
    incircle_mesh_free(mesh);
    plan.domain = INCIRCLE_ALL;
    options.threads = 0;
    options.backend = "model";
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, &options, &plan, &made), INCIRCLE_OK);
    IS(incircle_constrained_verify(made, NULL, &plan), INCIRCLE_OK);
    incircle_constrained_free(made);
    const uint32_t crossed[][2] = {{0, 2}, {1, 3}}, wrong[][2] = {{0, 8}};
    plan.constraints = crossed;
    plan.constraint_count = 2;
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, NULL, &plan, &made), INCIRCLE_INPUT);
    TRUE(made == NULL);
    plan.constraints = wrong;
    plan.constraint_count = 1;
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, NULL, &plan, &made), INCIRCLE_INPUT);
    says("constraint 0 names point 8, but the number of points is 8");
    plan.constraint_count = 0;
    const double nan[][2] = {{0, 0}, {NAN, 4}};
    IS(incircle_triangulate_constrained(nan, 2, INCIRCLE_F64, NULL, &plan, &made), INCIRCLE_INPUT);
    IS(incircle_triangulate_constrained(NULL, 0, INCIRCLE_F64, NULL, &plan, &made), INCIRCLE_OK);
    incircle_constrained_free(made);
    IS(incircle_triangulate_constrained(NULL, 8, INCIRCLE_I32, NULL, &plan, &made), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate_constrained(FRAME, 8, 7, NULL, &plan, &made), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, NULL, NULL, &made), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, NULL, &plan, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate_constrained(FRAME, SIZE_MAX, INCIRCLE_I32, NULL, &plan, &made), INCIRCLE_CAPACITY);
    options.threads = 300;
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, &options, &plan, &made), INCIRCLE_CHOICE);
    IS(incircle_constrained_hull(NULL, hull, 8, &count), INCIRCLE_ARGUMENT);
}

static int32_t stop_in_the_last_stage(void *user, const char *stage, size_t done, size_t total) {
    ++*(int *)user;
    return strcmp(stage, "assemble") == 0 && done <= total;
}

static void a_job_with_constraints_ends_when_asked(void) {
    incircle_constrained *made;
    int heard = 0;
    incircle_plan plan = {.size = sizeof plan, .constraints = RINGS, .constraint_count = 8};
    incircle_options options = {.size = sizeof options, .progress = stop_in_the_last_stage, .user = &heard};
    IS(incircle_triangulate_constrained(FRAME, 8, INCIRCLE_I32, &options, &plan, &made), INCIRCLE_CANCELLED);
    TRUE(heard >= 3 && made == NULL);
}

static void cells_keep_out_of_holes(void) {
    static const int32_t points[][2] = {{5, 5}, {15, 5}};
    static const int32_t rings[][2] = {{0, 0}, {20, 0}, {20, 10}, {0, 10}, {2, 2}, {4, 2},
                                       {4, 4}, {2, 4}, {8, 5}, {12, 5}, {12, 7}, {8, 7}};
    const size_t counts[] = {4, 4, 4}, few[] = {10, 2}, huge[] = {SIZE_MAX, 5};
    incircle_diagram *diagram;
    uint8_t flags[4];
    uint64_t starts[8];
    uint32_t list[8];
    double areas[2];
    size_t count;
    IS(incircle_diagram_new_with_holes(points, 2, rings, counts, 3, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_OK);
    IS(incircle_diagram_areas(diagram, areas, 2, &count), INCIRCLE_OK);
    TRUE(areas[0] == 92 && areas[1] == 96);
    IS(incircle_diagram_ring_is_hole(diagram, flags, 2, &count), INCIRCLE_BUFFER);
    IS(incircle_diagram_ring_is_hole(diagram, flags, 4, &count), INCIRCLE_OK);
    TRUE(count == 3 && flags[0] == 0 && flags[1] == 1 && flags[2] == 0);
    IS(incircle_diagram_piece_points(diagram, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 3 && list[0] == 0 && list[1] == 0 && list[2] == 1);
    IS(incircle_diagram_piece_starts(diagram, starts, 8, &count), INCIRCLE_OK);
    TRUE(count == 4 && starts[2] - starts[1] == 4);
    incircle_diagram_free(diagram);
    IS(incircle_diagram_new_with_holes(points, 2, rings, counts, 1, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_OK);
    IS(incircle_diagram_areas(diagram, areas, 2, &count), INCIRCLE_OK);
    TRUE(areas[0] == 100 && areas[1] == 100);
    incircle_diagram_free(diagram);
    IS(incircle_diagram_new_with_holes(points, 2, rings, counts, 0, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    says("the clip has 0 rings");
    IS(incircle_diagram_new_with_holes(points, 2, rings, few, 2, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    IS(incircle_diagram_new_with_holes(points, 2, rings, huge, 2, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_CAPACITY);
    IS(incircle_diagram_new_with_holes(points, 2, rings + 4, counts, 2, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    TRUE(diagram == NULL);
    IS(incircle_diagram_new_with_holes(points, 2, rings, NULL, 3, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new_with_holes(points, 2, NULL, counts, 3, INCIRCLE_I32, INCIRCLE_EXACT, &diagram), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new_with_holes(points, 2, rings, counts, 3, INCIRCLE_I32, INCIRCLE_EXACT, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_ring_is_hole(NULL, flags, 4, &count), INCIRCLE_ARGUMENT);
}

static void points_follow_a_density_and_keep_out_of_holes(void) {
    static const int32_t points[][2] = {{7, 7}}, box[][2] = {{0, 0}, {400, 100}};
    static const int32_t rings[][2] = {{0, 0}, {400, 0}, {400, 100}, {0, 100}, {200, 10}, {390, 10}, {390, 90}, {200, 90}};
    const uint16_t left[] = {3, 1}, upper[] = {1, 0}, nothing[] = {0, 0};
    const size_t counts[] = {4, 4};
    double places[1][2], free_place[1][2];
    incircle_relaxation choices = {.size = sizeof choices, .iterations = 1, .clip = box, .corner_count = 2};
    choices.density = left;
    choices.columns = 2;
    choices.rows = 1;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_OK);
    TRUE(places[0][0] == 150 && places[0][1] == 50);
    /* The first row lies uppermost. */
    choices.density = upper;
    choices.columns = 1;
    choices.rows = 2;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_OK);
    TRUE(places[0][0] == 200 && places[0][1] == 75);
    choices.density = nothing;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_INPUT);
    says("weigh nothing");
    choices.density = NULL;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_ARGUMENT);
    choices.density = left;
    choices.rows = 0;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_INPUT);
    choices.rows = SIZE_MAX;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_CAPACITY);
    choices.density = NULL;
    choices.columns = choices.rows = 0;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, free_place, 1, NULL), INCIRCLE_OK);
    TRUE(free_place[0][0] == 200 && free_place[0][1] == 50);
    choices.clip = rings;
    choices.corner_count = 8;
    choices.ring_counts = counts;
    choices.ring_count = 2;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_OK);
    TRUE(places[0][0] < 150 && fabs(places[0][1] - 50) < 1e-3);
    choices.corner_count = 7;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_INPUT);
    says("the rings of the clip have 8 corners, but the clip has 7");
    choices.ring_counts = NULL;
    IS(incircle_lloyd(points, 1, INCIRCLE_I32, &choices, places, 1, NULL), INCIRCLE_ARGUMENT);
}

static void cells_have_their_lists(void) {
    static const double points[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}, {2, 2}};
    const double box[][2] = {{0, 0}, {4, 4}}, flat[][2] = {{0, 0}, {0, 4}}, nan[][2] = {{0, 0}, {NAN, 4}};
    incircle_diagram *diagram;
    uint64_t starts[16];
    uint32_t list[64], duplicates[1][2];
    double places[64][2], areas[6], error = -1;
    size_t count;
    IS(incircle_diagram_new(points, 6, box, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_OK);
    IS(incircle_diagram_vertices(diagram, NULL, 0, &count), INCIRCLE_OK);
    TRUE(count == 4);
    IS(incircle_diagram_vertices(diagram, places, 3, &count), INCIRCLE_BUFFER);
    IS(incircle_diagram_vertices(diagram, places, 64, &count), INCIRCLE_OK);
    IS(incircle_diagram_starts(diagram, starts, 16, &count), INCIRCLE_OK);
    TRUE(count == 7 && starts[5] - starts[4] == 4 && starts[6] == starts[5]);
    IS(incircle_diagram_neighbors(diagram, list, 64, &count), INCIRCLE_OK);
    TRUE(count == starts[6] && list[starts[4]] == 0 && list[starts[4] + 3] == 3);
    IS(incircle_diagram_corners(diagram, list, 64, &count), INCIRCLE_OK);
    TRUE(count == starts[6] && places[list[starts[4]]][0] == 0 && places[list[starts[4]]][1] == 2);
    IS(incircle_diagram_duplicates(diagram, duplicates, 1, &count), INCIRCLE_OK);
    TRUE(count == 1 && duplicates[0][0] == 5 && duplicates[0][1] == 4);
    IS(incircle_diagram_largest_error(diagram, &error), INCIRCLE_OK);
    TRUE(error == 0);
    IS(incircle_diagram_largest_error(diagram, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_areas(diagram, areas, 6, &count), INCIRCLE_OK);
    TRUE(count == 6 && areas[0] == 2 && areas[4] == 8 && areas[5] == 0);
    IS(incircle_diagram_piece_starts(diagram, starts, 16, &count), INCIRCLE_OK);
    TRUE(count == 6 && starts[5] == 16);
    IS(incircle_diagram_piece_points(diagram, list, 64, &count), INCIRCLE_OK);
    TRUE(count == 5 && list[4] == 4);
    IS(incircle_diagram_cell_corners(diagram, places, 64, &count), INCIRCLE_OK);
    TRUE(count == 16);
    IS(incircle_diagram_inside_starts(diagram, starts, 16, &count), INCIRCLE_OK);
    TRUE(count == 7);
    IS(incircle_diagram_inside(diagram, list, 64, &count), INCIRCLE_OK);
    TRUE(count == starts[6] && starts[5] - starts[4] == 4 && list[starts[4]] == 0);
    incircle_diagram_free(diagram);
    IS(incircle_diagram_new(points, 6, NULL, 0, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_OK);
    IS(incircle_diagram_areas(diagram, areas, 6, &count), INCIRCLE_CHOICE);
    says("the diagram has no clip");
    incircle_diagram_free(diagram);
    IS(incircle_diagram_new(NULL, 0, NULL, 0, INCIRCLE_U32, INCIRCLE_EXACT, &diagram), INCIRCLE_OK);
    IS(incircle_diagram_starts(diagram, starts, 16, &count), INCIRCLE_OK);
    TRUE(count == 1);
    incircle_diagram_free(diagram);
    const double fine[][2] = {{0.1, 0.2}, {0.7, 1e-9}, {0.3, 0.9}};
    IS(incircle_diagram_new(fine, 3, NULL, 0, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    says("on no lattice");
    IS(incircle_diagram_new(fine, 3, NULL, 0, INCIRCLE_F64, INCIRCLE_QUANTIZE, &diagram), INCIRCLE_OK);
    IS(incircle_diagram_largest_error(diagram, &error), INCIRCLE_OK);
    TRUE(error > 0 && error < 1e-8);
    incircle_diagram_free(diagram);
    IS(incircle_diagram_new(points, 6, flat, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    IS(incircle_diagram_new(points, 6, nan, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    IS(incircle_diagram_new(points, 6, box, 1, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_INPUT);
    says("the clip has 1 corner");
    IS(incircle_diagram_new(points, 6, NULL, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new(NULL, 6, box, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new(points, 6, box, 2, 5, INCIRCLE_EXACT, &diagram), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new(points, 6, box, 2, INCIRCLE_F64, 2, &diagram), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new(points, 6, box, 2, INCIRCLE_F64, INCIRCLE_EXACT, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_new(points, SIZE_MAX, box, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram), INCIRCLE_CAPACITY);
    IS(incircle_diagram_areas(NULL, areas, 6, &count), INCIRCLE_ARGUMENT);
    IS(incircle_diagram_vertices(NULL, places, 6, &count), INCIRCLE_ARGUMENT);
    incircle_diagram_free(NULL);
}

static void points_spread_evenly(void) {
    static const int64_t points[][2] = {{1, 1}, {2, 9}, {9, 5}}, box[][2] = {{0, 0}, {10, 10}};
    double places[3][2], again[3][2];
    incircle_relaxed relaxed;
    incircle_relaxation choices = {.size = sizeof choices, .iterations = 100000, .until_still = 1};
    choices.clip = box;
    choices.corner_count = 2;
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, places, 3, &relaxed), INCIRCLE_OK);
    TRUE(relaxed.end == INCIRCLE_STILL && relaxed.moved == 0 && relaxed.iterations > 1 && relaxed.largest_error == 0);
    TRUE(fabs(places[2][1] - 5) < 1e-3 && fabs(places[0][1] + places[1][1] - 10) < 1e-3);
    choices.threads = 2;
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, again, 3, NULL), INCIRCLE_OK);
    TRUE(memcmp(places, again, sizeof places) == 0);
    choices.iterations = 1;
    choices.quantize = INCIRCLE_QUANTIZE;
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, again, 3, &relaxed), INCIRCLE_OK);
    TRUE(relaxed.end == INCIRCLE_ITERATIONS && relaxed.iterations == 1);
    IS(incircle_lloyd(NULL, 0, INCIRCLE_I64, &choices, NULL, 0, &relaxed), INCIRCLE_OK);
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, places, 2, &relaxed), INCIRCLE_BUFFER);
    says("has room for 2 items, but there are 3");
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, NULL, 3, &relaxed), INCIRCLE_ARGUMENT);
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, NULL, places, 3, &relaxed), INCIRCLE_ARGUMENT);
    IS(incircle_lloyd(points, 3, 7, &choices, places, 3, &relaxed), INCIRCLE_ARGUMENT);
    choices.until_still = 2;
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, places, 3, &relaxed), INCIRCLE_ARGUMENT);
    choices.until_still = 0;
    choices.iterations = 0;
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, places, 3, &relaxed), INCIRCLE_CHOICE);
    choices.iterations = 1;
    choices.quantize = INCIRCLE_EXACT;
    choices.corner_count = 0;
    IS(incircle_lloyd(points, 1, INCIRCLE_I64, &choices, places, 3, &relaxed), INCIRCLE_INPUT);
    says("has no area: give a clip");
    const int64_t wide[][2] = {{0, 0}, {1 << 24, 5}};
    IS(incircle_lloyd(wide, 2, INCIRCLE_I64, &choices, places, 3, &relaxed), INCIRCLE_INPUT);
    says("need 25 bits on their lattice, but 23 are possible");
    choices.size = 1;
    IS(incircle_lloyd(points, 3, INCIRCLE_I64, &choices, places, 3, &relaxed), INCIRCLE_ARGUMENT);
}

static void surfaces_have_values(void) {
    const double values[] = {0, 4, 8, 4, 99}, wrong[] = {0, 4, NAN, 4, 99};
    const double places[][2] = {{3, 1}, {9, 9}, {NAN, 0}, {4, 0}};
    double heights[4], line[8][2];
    size_t count, starts[2];
    uint8_t closed[1];
    incircle_surface *surface;
    incircle_contours *contours;
    IS(incircle_surface_new(SQUARE, values, 5, &surface), INCIRCLE_OK);
    for (uint32_t method = INCIRCLE_LINEAR; method <= INCIRCLE_SIBSON; ++method) {
        IS(incircle_surface_values(surface, method, INCIRCLE_NAN, 1, places, 4, heights), INCIRCLE_OK);
        TRUE(fabs(heights[0] - 4) < 1e-12 && isnan(heights[1]) && isnan(heights[2]) && heights[3] == 4);
    }
    IS(incircle_surface_values(surface, INCIRCLE_LINEAR, INCIRCLE_NEAREST, 0, places, 4, heights), INCIRCLE_OK);
    TRUE(heights[1] == 8 && isnan(heights[2]));
    IS(incircle_surface_values(surface, INCIRCLE_LINEAR, INCIRCLE_NAN, 0, NULL, 0, NULL), INCIRCLE_OK);
    IS(incircle_surface_values(surface, INCIRCLE_LINEAR, INCIRCLE_NAN, 0, NULL, 4, heights), INCIRCLE_ARGUMENT);
    IS(incircle_surface_values(surface, INCIRCLE_LINEAR, INCIRCLE_NAN, 0, places, 4, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_surface_values(surface, 3, INCIRCLE_NAN, 0, places, 4, heights), INCIRCLE_ARGUMENT);
    IS(incircle_surface_values(surface, INCIRCLE_LINEAR, 2, 0, places, 4, heights), INCIRCLE_ARGUMENT);
    IS(incircle_surface_values(NULL, INCIRCLE_LINEAR, INCIRCLE_NAN, 0, places, 4, heights), INCIRCLE_ARGUMENT);
    IS(incircle_surface_contours(surface, 2, &contours), INCIRCLE_OK);
    IS(incircle_contours_places(contours, line, 8, &count), INCIRCLE_OK);
    TRUE(count == 3 && line[1][0] == 1 && line[1][1] == 1);
    IS(incircle_contours_starts(contours, starts, 2, &count), INCIRCLE_OK);
    TRUE(count == 2 && starts[1] == 3);
    IS(incircle_contours_closed(contours, closed, 1, &count), INCIRCLE_OK);
    TRUE(count == 1 && closed[0] == 0);
    incircle_contours_free(contours);
    IS(incircle_surface_contours(surface, NAN, &contours), INCIRCLE_OK);
    IS(incircle_contours_places(contours, NULL, 0, &count), INCIRCLE_OK);
    TRUE(count == 0);
    incircle_contours_free(contours);
    IS(incircle_surface_contours(NULL, 2, &contours), INCIRCLE_ARGUMENT);
    IS(incircle_surface_contours(surface, 2, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_contours_closed(NULL, closed, 1, &count), INCIRCLE_ARGUMENT);
    incircle_surface_free(surface);
    IS(incircle_surface_new(SQUARE, wrong, 5, &surface), INCIRCLE_INPUT);
    says("the value of point 2 is NaN");
    IS(incircle_surface_new(SQUARE, values, 2, &surface), INCIRCLE_INPUT);
    IS(incircle_surface_new(NULL, values, 2, &surface), INCIRCLE_ARGUMENT);
    IS(incircle_surface_new(SQUARE, NULL, 2, &surface), INCIRCLE_ARGUMENT);
    IS(incircle_surface_new(SQUARE, values, 5, NULL), INCIRCLE_ARGUMENT);
    incircle_surface_free(NULL);
    incircle_contours_free(NULL);
}

int main(void) {
    constraints_bound_a_domain();
    points_and_constraints_are_one_job();
    a_job_with_constraints_ends_when_asked();
    cells_keep_out_of_holes();
    points_follow_a_density_and_keep_out_of_holes();
    cells_have_their_lists();
    points_spread_evenly();
    surfaces_have_values();
    return failures != 0;
}
