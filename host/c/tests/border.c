/* Calls the functions for meshes with good and bad arguments. `test` runs it with and without sanitisers. */
#include "expect.h"

static void meshes_have_their_lists(void) {
    incircle_mesh *mesh;
    size_t count;
    uint32_t triangles[2][3], hull[4], duplicates[1][2], halfedges[6];
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, NULL, &mesh), INCIRCLE_OK);
    IS(incircle_mesh_triangles(mesh, NULL, 0, &count), INCIRCLE_OK);
    TRUE(count == 2);
    IS(incircle_mesh_triangles(mesh, triangles, 1, &count), INCIRCLE_BUFFER);
    TRUE(count == 2);
    says("has room for 1 items, but there are 2");
    IS(incircle_mesh_triangles(mesh, triangles, 2, &count), INCIRCLE_OK);
    const uint32_t expected[2][3] = {{0, 1, 2}, {0, 2, 3}};
    TRUE(memcmp(triangles, expected, sizeof expected) == 0);
    IS(incircle_mesh_hull(mesh, hull, 4, &count), INCIRCLE_OK);
    TRUE(count == 4 && hull[0] == 0 && hull[3] == 3);
    IS(incircle_mesh_duplicates(mesh, duplicates, 1, &count), INCIRCLE_OK);
    TRUE(count == 1 && duplicates[0][0] == 4 && duplicates[0][1] == 1);
    IS(incircle_mesh_halfedges(mesh, NULL, 0, &count), INCIRCLE_OK);
    TRUE(count == 6);
    IS(incircle_mesh_halfedges(mesh, halfedges, 5, &count), INCIRCLE_BUFFER);
    IS(incircle_mesh_halfedges(mesh, halfedges, 6, &count), INCIRCLE_OK);
    TRUE(halfedges[0] == UINT32_MAX && halfedges[2] == 3 && halfedges[3] == 2);
    IS(incircle_mesh_verify(mesh), INCIRCLE_OK);
    incircle_mesh_free(mesh);
}

static void all_types_and_few_points(void) {
    const float f[][2] = {{0, 0}, {4, 0}, {0, 4}};
    const int64_t l[][2] = {{INT64_MIN, 0}, {INT64_MAX, 0}, {0, INT64_MAX}};
    const int32_t i[][2] = {{-1, 0}, {4, 0}, {0, 4}};
    const uint32_t u[][2] = {{0, 0}, {UINT32_MAX, 0}, {0, 4}};
    const void *lists[] = {SQUARE, f, l, i, u};
    for (uint32_t number = 0; number < 5; ++number) {
        for (size_t points = 0; points <= 3; ++points) {
            incircle_mesh *mesh;
            size_t count;
            IS(incircle_triangulate(lists[number], points, number, NULL, &mesh), INCIRCLE_OK);
            IS(incircle_mesh_triangles(mesh, NULL, 0, &count), INCIRCLE_OK);
            TRUE(count == (points == 3));
            IS(incircle_mesh_verify(mesh), INCIRCLE_OK);
            incircle_mesh_free(mesh);
        }
    }
}

static int heard = 0;

static int tell(void *user, const char *stage, size_t done, size_t total) {
    ++heard;
    TRUE(done <= total);
    return user != NULL && strcmp(stage, user) == 0;
}

static void options_are_taken_or_refused(void) {
    incircle_mesh *mesh;
    incircle_options options = {0};
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_ARGUMENT);
    says("the options have 0 bytes");
    TRUE(mesh == NULL);
    options.size = sizeof options;
    options.backend = "model";
    options.progress = tell;
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_OK);
    TRUE(heard > 0);
    incircle_mesh_free(mesh);
    options.user = "insert";
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_CANCELLED);
    TRUE(mesh == NULL);
    options.progress = NULL;
    options.threads = 2;
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_CHOICE);
    options.backend = NULL;
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_OK);
    incircle_mesh_free(mesh);
    options.threads = 257;
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_CHOICE);
    options.threads = 0;
    options.backend = "modem";
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_DEVICE_NOT_FOUND);
    options.backend = "\xff";
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, &options, &mesh), INCIRCLE_ARGUMENT);
}

static void bad_arguments_are_refused(void) {
    incircle_mesh *mesh = NULL;
    size_t count;
    uint32_t list[8];
    double points[3][2] = {{0, 0}, {1, NAN}, {2, 2}};
    IS(incircle_triangulate(points, 3, INCIRCLE_F64, NULL, &mesh), INCIRCLE_INPUT);
    says("the y of point 1 is NaN");
    points[1][1] = INFINITY;
    IS(incircle_triangulate(points, 3, INCIRCLE_F64, NULL, &mesh), INCIRCLE_INPUT);
    IS(incircle_triangulate(NULL, 3, INCIRCLE_F64, NULL, &mesh), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate((const char *)points + 1, 2, INCIRCLE_F64, NULL, &mesh), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate(points, 3, 5, NULL, &mesh), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate(points, 3, UINT32_MAX, NULL, &mesh), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate(points, 3, INCIRCLE_F64, NULL, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_triangulate(points, SIZE_MAX, INCIRCLE_F64, NULL, &mesh), INCIRCLE_CAPACITY);
    IS(incircle_triangulate(points, SIZE_MAX / 16 + 2, INCIRCLE_F64, NULL, &mesh), INCIRCLE_CAPACITY);
    IS(incircle_mesh_triangles(NULL, NULL, 0, &count), INCIRCLE_ARGUMENT);
    IS(incircle_mesh_hull(NULL, list, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_mesh_duplicates(NULL, NULL, 0, &count), INCIRCLE_ARGUMENT);
    IS(incircle_mesh_halfedges(NULL, list, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_mesh_verify(NULL), INCIRCLE_ARGUMENT);
    incircle_mesh_free(NULL);
    IS(incircle_triangulate(SQUARE, 5, INCIRCLE_F64, NULL, &mesh), INCIRCLE_OK);
    IS(incircle_mesh_hull(mesh, NULL, 0, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_mesh_hull(mesh, (uint32_t *)((char *)list + 1), 4, &count), INCIRCLE_ARGUMENT);
    incircle_mesh_free(mesh);
}

static void a_mesh_lives(void) {
    incircle_triangulation *living;
    incircle_location location;
    uint32_t index, list[8];
    size_t count;
    const double middle[2] = {2, 1}, nan[2] = {0, NAN};
    IS(incircle_triangulation_new(SQUARE, 4, INCIRCLE_F64, &living), INCIRCLE_OK);
    IS(incircle_triangulation_insert(living, middle, &index), INCIRCLE_OK);
    TRUE(index == 4);
    IS(incircle_triangulation_neighbors(living, 4, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 4 && list[0] == 0 && list[3] == 3);
    IS(incircle_triangulation_locate(living, middle, &location), INCIRCLE_OK);
    TRUE(location.kind == INCIRCLE_VERTEX && location.vertices[0] == 4 && location.vertices[1] == INCIRCLE_EMPTY);
    IS(incircle_triangulation_nearest(living, middle, &index), INCIRCLE_OK);
    TRUE(index == 4);
    IS(incircle_triangulation_move(living, 4, SQUARE[2]), INCIRCLE_OK);
    IS(incircle_triangulation_indices(living, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 5 && list[4] == 4);
    IS(incircle_triangulation_delete(living, 4), INCIRCLE_OK);
    IS(incircle_triangulation_delete(living, 4), INCIRCLE_INDEX);
    says("point 4 was deleted");
    IS(incircle_triangulation_move(living, 9, middle), INCIRCLE_INDEX);
    IS(incircle_triangulation_neighbors(living, 9, list, 8, &count), INCIRCLE_INDEX);
    IS(incircle_triangulation_insert(living, nan, &index), INCIRCLE_INPUT);
    IS(incircle_triangulation_locate(living, nan, &location), INCIRCLE_OK);
    TRUE(location.kind == INCIRCLE_NONE);
    IS(incircle_triangulation_move_all(living, SQUARE, 3), INCIRCLE_INPUT);
    IS(incircle_triangulation_move_all(living, SQUARE, 4), INCIRCLE_OK);
    IS(incircle_triangulation_move_all(living, NULL, 4), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_insert(living, NULL, &index), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_insert(living, middle, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_insert(NULL, middle, &index), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_locate(living, middle, NULL), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_nearest(NULL, middle, &index), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_indices(NULL, NULL, 0, &count), INCIRCLE_ARGUMENT);
    incircle_mesh *mesh;
    IS(incircle_triangulation_mesh(living, &mesh), INCIRCLE_OK);
    IS(incircle_mesh_verify(mesh), INCIRCLE_OK);
    incircle_mesh_free(mesh);
    incircle_triangulation_free(living);
    incircle_triangulation_free(NULL);
    IS(incircle_triangulation_new(NULL, 0, INCIRCLE_I32, &living), INCIRCLE_OK);
    const int32_t place[2] = {7, 8};
    IS(incircle_triangulation_nearest(living, place, &index), INCIRCLE_OK);
    TRUE(index == INCIRCLE_EMPTY);
    IS(incircle_triangulation_insert(living, place, &index), INCIRCLE_OK);
    incircle_triangulation_free(living);
    IS(incircle_triangulation_new(NULL, 1, INCIRCLE_I32, &living), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_new(NULL, 0, 9, &living), INCIRCLE_ARGUMENT);
    TRUE(living == NULL);
}

static void questions_have_lists_as_answers(void) {
    incircle_triangulation *living;
    uint32_t list[8], triangles[8][3];
    size_t count;
    int32_t grid[25][2];
    for (int32_t k = 0; k < 25; ++k) {
        grid[k][0] = k % 5;
        grid[k][1] = k / 5;
    }
    const int32_t middle[2] = {2, 2}, corner[2] = {3, 3}, left[2] = {-9, 2}, right[2] = {9, 2};
    IS(incircle_triangulation_new(grid, 25, INCIRCLE_I32, &living), INCIRCLE_OK);
    IS(incircle_triangulation_k_nearest(living, middle, 5, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 5 && list[0] == 12 && list[1] == 11 && list[2] == 7 && list[3] == 17 && list[4] == 13);
    IS(incircle_triangulation_k_nearest(living, middle, SIZE_MAX, NULL, 0, &count), INCIRCLE_OK);
    TRUE(count == 25);
    IS(incircle_triangulation_k_nearest(living, middle, SIZE_MAX, list, 8, &count), INCIRCLE_BUFFER);
    IS(incircle_triangulation_k_nearest(living, middle, 0, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 0);
    IS(incircle_triangulation_within_circle(living, middle, 1, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 5 && list[0] == 7 && list[4] == 17);
    IS(incircle_triangulation_within_circle(living, middle, -1, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 0);
    IS(incircle_triangulation_within_circle(living, middle, NAN, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 0);
    IS(incircle_triangulation_within_rectangle(living, corner, middle, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 4 && list[0] == 12 && list[3] == 18);
    IS(incircle_triangulation_star(living, 0, triangles, 8, &count), INCIRCLE_OK);
    TRUE(count == 2 && triangles[0][0] == 0 && triangles[1][0] == 0);
    IS(incircle_triangulation_star(living, 25, triangles, 8, &count), INCIRCLE_INDEX);
    const int32_t low[2] = {0, 1}, high[2] = {4, 2};
    IS(incircle_triangulation_segment(living, low, high, triangles, 8, &count), INCIRCLE_OK);
    TRUE(count >= 4);
    IS(incircle_triangulation_segment(living, left, right, triangles, 8, &count), INCIRCLE_OK);
    TRUE(count == 0); /* The line runs along edges. */
    IS(incircle_triangulation_k_nearest(NULL, middle, 1, list, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_k_nearest(living, NULL, 1, list, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_within_circle(living, NULL, 1, list, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_within_rectangle(living, middle, NULL, list, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_segment(living, NULL, middle, triangles, 8, &count), INCIRCLE_ARGUMENT);
    IS(incircle_triangulation_star(living, 0, triangles, 8, NULL), INCIRCLE_ARGUMENT);
    incircle_triangulation_free(living);
    const double place[2] = {NAN, 1}, inside[2] = {2, 1};
    IS(incircle_triangulation_new(SQUARE, 4, INCIRCLE_F64, &living), INCIRCLE_OK);
    IS(incircle_triangulation_k_nearest(living, place, 4, list, 8, &count), INCIRCLE_OK);
    TRUE(count == 0);
    IS(incircle_triangulation_segment(living, place, inside, triangles, 8, &count), INCIRCLE_OK);
    TRUE(count == 0);
    incircle_triangulation_free(living);
}

/* Points on a spiral: all different, in no order. */
static double (*spiral(size_t count))[2] {
    double(*points)[2] = malloc(count * sizeof *points);
    for (size_t k = 0; points != NULL && k < count; ++k) {
        points[k][0] = sqrt((double)k) * cos(2.4 * (double)k);
        points[k][1] = sqrt((double)k) * sin(2.4 * (double)k);
    }
    return points;
}

/* The command runs this with too little memory. */
static void memory_runs_out(void) {
    const size_t count = 1000000;
    double(*points)[2] = spiral(count);
    incircle_mesh *mesh;
    incircle_triangulation *living;
    TRUE(points != NULL);
    IS(incircle_triangulate(points, count, INCIRCLE_F64, NULL, &mesh), INCIRCLE_MEMORY);
    says("there is no memory for 200000000 bytes");
    IS(incircle_triangulation_new(points, count, INCIRCLE_F64, &living), INCIRCLE_MEMORY);
    IS(incircle_triangulation_new(NULL, 0, INCIRCLE_F64, &living), INCIRCLE_OK);
    int status = INCIRCLE_OK;
    for (size_t k = 0; k < count && status == INCIRCLE_OK; ++k) {
        uint32_t index;
        status = incircle_triangulation_insert(living, points[k], &index);
    }
    TRUE(status == INCIRCLE_MEMORY);
    const double place[2] = {1, 1};
    uint32_t index;
    IS(incircle_triangulation_nearest(living, place, &index), INCIRCLE_OK);
    incircle_triangulation_free(living);
    IS(incircle_triangulate(points, 1000, INCIRCLE_F64, NULL, &mesh), INCIRCLE_OK);
    incircle_mesh_free(mesh);
    free(points);
}

int main(int count, char **arguments) {
    if (count > 1 && strcmp(arguments[1], "memory") == 0) {
        memory_runs_out();
        return failures != 0;
    }
    TRUE(incircle_abi() == INCIRCLE_ABI);
    meshes_have_their_lists();
    all_types_and_few_points();
    options_are_taken_or_refused();
    bad_arguments_are_refused();
    a_mesh_lives();
    questions_have_lists_as_answers();
    /* Leaks would show in the sanitiser. */
    double(*points)[2] = spiral(50000);
    for (int round = 0; round < 5; ++round) {
        incircle_mesh *mesh;
        incircle_options options = {.size = sizeof options, .progress = tell, .user = round % 2 ? "assemble" : NULL};
        IS(incircle_triangulate(points, 50000, INCIRCLE_F64, &options, &mesh), round % 2 ? INCIRCLE_CANCELLED : 0);
        incircle_mesh_free(mesh);
    }
    free(points);
    return failures != 0;
}
