/* Calls the functions for constrained jobs, clips with holes and densities with good and bad arguments. */
#include "expect.h"

/* A frame around a hole. */
static const int32_t FRAME[][2] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 6}};
static const uint32_t RINGS[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};

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

#define CELLS(clip, counts, ring_count, out, status)                                                             \
    IS(incircle_diagram_new_with_holes(points, 2, clip, counts, ring_count, INCIRCLE_I32, INCIRCLE_EXACT, out), \
       status)

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
    CELLS(rings, counts, 3, &diagram, INCIRCLE_OK);
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
    CELLS(rings, counts, 1, &diagram, INCIRCLE_OK);
    IS(incircle_diagram_areas(diagram, areas, 2, &count), INCIRCLE_OK);
    TRUE(areas[0] == 100 && areas[1] == 100);
    incircle_diagram_free(diagram);
    CELLS(rings, counts, 0, &diagram, INCIRCLE_INPUT);
    says("the clip has 0 rings");
    CELLS(rings, few, 2, &diagram, INCIRCLE_INPUT);
    CELLS(rings, huge, 2, &diagram, INCIRCLE_CAPACITY);
    CELLS(rings + 4, counts, 2, &diagram, INCIRCLE_INPUT);
    TRUE(diagram == NULL);
    CELLS(rings, NULL, 3, &diagram, INCIRCLE_ARGUMENT);
    CELLS(NULL, counts, 3, &diagram, INCIRCLE_ARGUMENT);
    CELLS(rings, counts, 3, NULL, INCIRCLE_ARGUMENT);
    IS(incircle_diagram_ring_is_hole(NULL, flags, 4, &count), INCIRCLE_ARGUMENT);
}

static void points_follow_a_density_and_keep_out_of_holes(void) {
    static const int32_t points[][2] = {{7, 7}}, box[][2] = {{0, 0}, {400, 100}};
    static const int32_t rings[][2] = {{0, 0},    {400, 0},  {400, 100}, {0, 100},
                                       {200, 10}, {390, 10}, {390, 90},  {200, 90}};
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

int main(void) {
    points_and_constraints_are_one_job();
    a_job_with_constraints_ends_when_asked();
    cells_keep_out_of_holes();
    points_follow_a_density_and_keep_out_of_holes();
    return failures != 0;
}
