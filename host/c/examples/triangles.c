/* Triangulates five points and prints the triangles. */
#include <incircle.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const char *what) {
    char text[512];
    incircle_error(text, sizeof text);
    fprintf(stderr, "%s: %s\n", what, text);
    return EXIT_FAILURE;
}

int main(void) {
    const double points[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {4, 0}};
    incircle_mesh *mesh;
    if (incircle_triangulate(points, 5, INCIRCLE_F64, NULL, &mesh) != INCIRCLE_OK) return fail("triangulate");

    size_t count;
    if (incircle_mesh_triangles(mesh, NULL, 0, &count) != INCIRCLE_OK) return fail("triangles");
    uint32_t(*triangles)[3] = malloc(count * sizeof *triangles);
    if (triangles == NULL || incircle_mesh_triangles(mesh, triangles, count, &count) != INCIRCLE_OK) {
        return fail("triangles");
    }
    for (size_t t = 0; t < count; ++t) printf("%u %u %u\n", triangles[t][0], triangles[t][1], triangles[t][2]);
    free(triangles);
    incircle_mesh_free(mesh);
    return EXIT_SUCCESS;
}
