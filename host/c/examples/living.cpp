// Keeps a mesh of points that come and go, with C++ types that free what C hands out.
#include <incircle.h>

#include <array>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Place = std::array<double, 2>;

void check(int status) {
    if (status == INCIRCLE_OK) return;
    std::string text(incircle_error(nullptr, 0), '\0');
    incircle_error(text.data(), text.size());
    text.pop_back();
    throw std::runtime_error(text);
}

class Triangulation {
   public:
    explicit Triangulation(const std::vector<Place>& points) {
        incircle_triangulation* made = nullptr;
        check(incircle_triangulation_new(points.data(), points.size(), INCIRCLE_F64, &made));
        handle_.reset(made);
    }

    std::uint32_t insert(Place place) {
        std::uint32_t index = INCIRCLE_EMPTY;
        check(incircle_triangulation_insert(handle_.get(), place.data(), &index));
        return index;
    }

    void erase(std::uint32_t index) { check(incircle_triangulation_delete(handle_.get(), index)); }

    std::uint32_t nearest(Place place) const {
        std::uint32_t index = INCIRCLE_EMPTY;
        check(incircle_triangulation_nearest(handle_.get(), place.data(), &index));
        return index;
    }

    std::vector<std::uint32_t> neighbors(std::uint32_t index) const {
        std::size_t count = 0;
        check(incircle_triangulation_neighbors(handle_.get(), index, nullptr, 0, &count));
        std::vector<std::uint32_t> found(count);
        check(incircle_triangulation_neighbors(handle_.get(), index, found.data(), found.size(), &count));
        return found;
    }

   private:
    struct Free {
        void operator()(incircle_triangulation* handle) const { incircle_triangulation_free(handle); }
    };
    std::unique_ptr<incircle_triangulation, Free> handle_;
};

}  // namespace

int main() {
    Triangulation mesh({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
    const std::uint32_t middle = mesh.insert({2, 1});
    for (std::uint32_t neighbor : mesh.neighbors(middle)) std::cout << neighbor << ' ';
    std::cout << "are around " << middle << ", which is nearest to (3, 1): " << mesh.nearest({3, 1}) << '\n';
    mesh.erase(middle);
    try {
        mesh.erase(middle);
    } catch (const std::runtime_error& error) {
        std::cout << error.what() << '\n';
    }
}
