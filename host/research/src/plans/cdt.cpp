// The library CDT as a peer. Standard input and output are as for cgal.cpp.
#include <CDT.h>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

template <class Item> static std::vector<Item> read(std::size_t count) {
    std::vector<Item> items(count);
    if (std::fread(items.data(), sizeof(Item), count, stdin) != count) std::exit(1);
    return items;
}

int main() {
    auto counts = read<std::uint64_t>(2);
    auto places = read<double>(2 * counts[0]);
    auto ends = read<std::uint32_t>(2 * counts[1]);
    std::vector<CDT::V2d<double>> points;
    std::vector<CDT::Edge> edges;
    for (std::size_t k = 0; k < counts[0]; ++k) points.emplace_back(places[2 * k], places[2 * k + 1]);
    for (std::size_t k = 0; k < counts[1]; ++k) edges.emplace_back(ends[2 * k], ends[2 * k + 1]);
    auto since = std::chrono::steady_clock::now();
    CDT::Triangulation<double> mesh;
    mesh.insertVertices(points);
    mesh.insertEdges(edges);
    mesh.eraseSuperTriangle();
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - since;
    double time = seconds.count();
    std::fwrite(&time, sizeof time, 1, stdout);
    for (const auto& triangle : mesh.triangles) {
        std::uint32_t corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = triangle.vertices[k];
        std::fwrite(corners, sizeof corners, 1, stdout);
    }
}
