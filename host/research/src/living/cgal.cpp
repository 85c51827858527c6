// CGAL's triangulations as a peer: commands on standard input, seconds and answers on standard output. One program is
// for one triangulation. A request is two numbers of 64 bits, the command and the count of its items, and then the
// items; an answer is the seconds as a double, the count of its numbers in 64 bits, and the numbers of 32 bits.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Numbered = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
template <class Vertex>
using Delaunay = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex, CGAL::Triangulation_face_base_2<Kernel>>>;
using Plain = Delaunay<Numbered>;
using Hierarchy = CGAL::Triangulation_hierarchy_2<Delaunay<CGAL::Triangulation_hierarchy_vertex_base_2<Numbered>>>;

enum Command : std::uint64_t { LOAD, LOCATE, NEAREST, INSERT, DELETE, TRIANGLES };
static const std::uint32_t NO_VERTEX = UINT32_MAX;

template <class Item> static bool read(std::vector<Item>& items) {
    return std::fread(items.data(), sizeof(Item), items.size(), stdin) == items.size();
}

// Walks begin at the last place, or at the top of the hierarchy, which pays no regard to a place.
template <class Mesh, bool FROM_LAST> struct Peer {
    Mesh mesh;
    std::vector<typename Mesh::Vertex_handle> vertices;
    typename Mesh::Face_handle last;
    std::vector<std::uint32_t> answers;
    double seconds = 0;

    typename Mesh::Face_handle start() const { return FROM_LAST ? last : typename Mesh::Face_handle(); }

    template <class Work> void timed(Work work) {
        auto since = std::chrono::steady_clock::now();
        work();
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
    }

    // Each item has a number and then a point, along a curve.
    bool load(std::uint64_t count) {
        vertices.resize(count);
        for (std::uint64_t k = 0; k < count; ++k) {
            std::vector<double> item(3);
            if (!read(item)) return false;
            auto vertex = mesh.insert(Point(item[1], item[2]), start());
            last = vertex->face();
            vertex->info() = std::uint32_t(item[0]);
            vertices[std::size_t(item[0])] = vertex;
        }
        return true;
    }

    void locate(const std::vector<Point>& places) {
        struct Found {
            typename Mesh::Face_handle face;
            typename Mesh::Locate_type type;
            int slot;
        };
        std::vector<Found> found(places.size());
        timed([&] {
            for (std::size_t k = 0; k < places.size(); ++k)
                last = found[k].face = mesh.locate(places[k], found[k].type, found[k].slot, start());
        });
        for (const Found& one : found) {
            std::uint32_t corners[3] = {NO_VERTEX, NO_VERTEX, NO_VERTEX};
            auto number = [&](int slot) { return one.face->vertex(slot % 3)->info(); };
            if (one.type == Mesh::VERTEX) corners[0] = number(one.slot);
            if (one.type == Mesh::EDGE) {
                corners[0] = std::min(number(one.slot + 1), number(one.slot + 2));
                corners[1] = std::max(number(one.slot + 1), number(one.slot + 2));
            }
            if (one.type == Mesh::FACE)
                for (int slot = 0; slot < 3; ++slot) corners[slot] = number(slot);
            answers.insert(answers.end(), corners, corners + 3);
        }
    }

    void nearest(const std::vector<Point>& places) {
        std::vector<typename Mesh::Vertex_handle> found(places.size());
        timed([&] {
            for (std::size_t k = 0; k < places.size(); ++k) {
                found[k] = mesh.nearest_vertex(places[k], start());
                last = found[k]->face();
            }
        });
        for (auto vertex : found) answers.push_back(vertex->info());
    }

    void insert(const std::vector<Point>& places) {
        std::size_t first = vertices.size();
        vertices.resize(first + places.size());
        timed([&] {
            for (std::size_t k = 0; k < places.size(); ++k) {
                auto vertex = mesh.insert(places[k], start());
                last = vertex->face();
                vertices[first + k] = vertex;
            }
        });
        for (std::size_t k = first; k < vertices.size(); ++k) vertices[k]->info() = std::uint32_t(k);
    }

    void remove(const std::vector<std::uint32_t>& numbers) {
        last = typename Mesh::Face_handle();
        timed([&] {
            for (auto number : numbers) mesh.remove(vertices[number]);
        });
    }

    void triangles() {
        for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
            for (int slot = 0; slot < 3; ++slot) answers.push_back(face->vertex(slot)->info());
    }

    bool run(std::uint64_t command, std::uint64_t count) {
        answers.clear();
        seconds = 0;
        if (command == LOAD) return load(count);
        if (command == TRIANGLES) return triangles(), true;
        if (command == DELETE) {
            std::vector<std::uint32_t> numbers(count);
            return read(numbers) && (remove(numbers), true);
        }
        std::vector<double> values(2 * count);
        if (!read(values)) return false;
        std::vector<Point> places;
        for (std::uint64_t k = 0; k < count; ++k) places.emplace_back(values[2 * k], values[2 * k + 1]);
        if (command == LOCATE) locate(places);
        if (command == NEAREST) nearest(places);
        if (command == INSERT) insert(places);
        return true;
    }

    int serve() {
        std::vector<std::uint64_t> head(2);
        while (read(head)) {
            if (!run(head[0], head[1])) return 1;
            std::uint64_t count = answers.size();
            std::fwrite(&seconds, sizeof seconds, 1, stdout);
            std::fwrite(&count, sizeof count, 1, stdout);
            std::fwrite(answers.data(), sizeof(std::uint32_t), answers.size(), stdout);
            std::fflush(stdout);
        }
        return 0;
    }
};

int main(int count, char** arguments) {
    bool from_last = count > 1 && std::strcmp(arguments[1], "last") == 0;
    return from_last ? Peer<Plain, true>().serve() : Peer<Hierarchy, false>().serve();
}
