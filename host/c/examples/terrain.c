/* Cuts a lake out of a terrain, and gives a height, a contour line and the area of a cell. */
#include <incircle.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int32_t status) {
    char text[512];
    if (status == INCIRCLE_OK) return;
    incircle_error(text, sizeof text);
    fprintf(stderr, "%s\n", text);
    exit(1);
}

int main(void) {
    const double points[][2] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 6}};
    const double heights[] = {5, 5, 7, 7, 1, 1, 1, 1};
    const uint32_t shores[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
    const double place[1][2] = {{4.5, 1.5}};
    const size_t rings[] = {4, 4};
    size_t count;

    incircle_constrained *land;
    incircle_plan plan = {.size = sizeof plan, .constraints = shores, .constraint_count = 8};
    plan.domain = INCIRCLE_EVEN_ODD;
    check(incircle_triangulate_constrained(points, 8, INCIRCLE_F64, NULL, &plan, &land));
    check(incircle_constrained_triangles(land, NULL, 0, &count));
    printf("the land has %zu triangles\n", count);
    incircle_constrained_free(land);

    incircle_surface *surface;
    incircle_contours *contours;
    double height;
    check(incircle_surface_new(points, heights, 8, &surface));
    check(incircle_surface_values(surface, INCIRCLE_SIBSON, INCIRCLE_NAN, 1, place, 1, &height));
    check(incircle_surface_contours(surface, 3, &contours));
    check(incircle_contours_places(contours, NULL, 0, &count));
    printf("the height is %.2f, and a contour line has %zu places\n", height, count);
    incircle_contours_free(contours);
    incircle_surface_free(surface);

    incircle_diagram *diagram;
    double areas[8];
    /* The points are the corners of the land and of the lake, into which no cell reaches. */
    check(incircle_diagram_new_with_holes(points, 8, points, rings, 2, INCIRCLE_F64, INCIRCLE_EXACT, &diagram));
    check(incircle_diagram_areas(diagram, areas, 8, &count));
    printf("the cell of the first point has the area %.3f on land\n", areas[0]);
    incircle_diagram_free(diagram);
    return 0;
}
