// CGAL's Delaunay triangulation as a peer: points on standard input, seconds and triangles on standard output.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Seconds that the processor spent on this program.
static double busy() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

int main() {
    std::uint64_t count;
    while (std::fread(&count, sizeof count, 1, stdin) == 1) {
        std::vector<double> values(2 * count);
        if (std::fread(values.data(), sizeof(double), values.size(), stdin) != values.size()) return 1;
        std::vector<Kernel::Point_2> points;
        points.reserve(count);
        for (std::uint64_t k = 0; k < count; ++k) points.emplace_back(values[2 * k], values[2 * k + 1]);
        double busy_since = busy();
        auto since = std::chrono::steady_clock::now();
        CGAL::Delaunay_triangulation_2<Kernel> mesh(points.begin(), points.end());
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - since;
        double spent = busy() - busy_since;
        // On a line it has edges only.
        std::size_t triangles = mesh.dimension() == 2 ? mesh.number_of_faces() : 0;
        std::printf("%.9f %.9f %zu\n", seconds.count(), spent, triangles);
        std::fflush(stdout);
    }
    return 0;
}
