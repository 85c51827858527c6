// Sibson's interpolation by CGAL as a peer. On standard input: the counts of points and of places in 64 bits, the points
// as pairs of doubles, a double for each point, and the places as pairs of doubles. On standard output: the seconds of
// processor time for all places as a double, and the value at each place; NaN outside the hull.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/function_objects.h>
#include <CGAL/natural_neighbor_coordinates_2.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<double, Kernel>;
using Mesh = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
using Share = std::pair<Mesh::Vertex_handle, Kernel::FT>;

template <class Item> static std::vector<Item> read(std::size_t count) {
    std::vector<Item> items(count);
    if (std::fread(items.data(), sizeof(Item), count, stdin) != count) std::exit(1);
    return items;
}

int main() {
    auto counts = read<std::uint64_t>(2);
    auto points = read<double>(2 * counts[0]);
    auto heights = read<double>(counts[0]);
    auto places = read<double>(2 * counts[1]);
    std::vector<std::pair<Point, double>> known;
    for (std::size_t k = 0; k < counts[0]; ++k) known.emplace_back(Point(points[2 * k], points[2 * k + 1]), heights[k]);
    Mesh mesh;
    mesh.insert(known.begin(), known.end());
    std::vector<double> values(counts[1]);
    std::vector<Share> shares;
    Mesh::Face_handle near;
    double since = double(std::clock()) / CLOCKS_PER_SEC;
    for (std::size_t k = 0; k < counts[1]; ++k) {
        Point place(places[2 * k], places[2 * k + 1]);
        near = mesh.locate(place, near);
        shares.clear();
        auto found = CGAL::natural_neighbor_coordinates_2(mesh, place, std::back_inserter(shares),
                                                          CGAL::Identity<Share>(), near);
        double sum = 0;
        for (const Share& share : shares) sum += share.second * share.first->info();
        values[k] = found.third ? sum / found.second : std::numeric_limits<double>::quiet_NaN();
    }
    double seconds = double(std::clock()) / CLOCKS_PER_SEC - since;
    std::fwrite(&seconds, sizeof seconds, 1, stdout);
    std::fwrite(values.data(), sizeof(double), values.size(), stdout);
}
