// CGAL's constrained triangulation as a peer. On standard input: the counts of points and of constraints in 64 bits, the
// points as pairs of doubles, the constraints as pairs of 32 bits. On standard output: the seconds as a double, and the
// corners of all triangles in 32 bits.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Mesh = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                                        CGAL::No_constraint_intersection_tag>;

template <class Item> static std::vector<Item> read(std::size_t count) {
    std::vector<Item> items(count);
    if (std::fread(items.data(), sizeof(Item), count, stdin) != count) std::exit(1);
    return items;
}

int main() {
    auto counts = read<std::uint64_t>(2);
    auto places = read<double>(2 * counts[0]);
    auto ends = read<std::uint32_t>(2 * counts[1]);
    std::vector<std::pair<Point, std::uint32_t>> points;
    for (std::size_t k = 0; k < counts[0]; ++k) points.emplace_back(Point(places[2 * k], places[2 * k + 1]), k);
    auto since = std::chrono::steady_clock::now();
    Mesh mesh;
    mesh.insert(points.begin(), points.end());
    std::vector<Mesh::Vertex_handle> vertices(counts[0]);
    for (auto vertex : mesh.finite_vertex_handles()) vertices[vertex->info()] = vertex;
    for (std::size_t k = 0; k < counts[1]; ++k) mesh.insert_constraint(vertices[ends[2 * k]], vertices[ends[2 * k + 1]]);
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - since;
    double time = seconds.count();
    std::fwrite(&time, sizeof time, 1, stdout);
    for (auto face : mesh.finite_face_handles()) {
        std::uint32_t corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = face->vertex(k)->info();
        std::fwrite(corners, sizeof corners, 1, stdout);
    }
}
