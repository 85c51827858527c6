// Threads: each has the sentence of its own last error, several read one mesh, and a thread may call while it ends.
#include <incircle.h>

#include <atomic>
#include <cstdint>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

std::atomic<int> failures{0};

void expect(bool condition, const char *what) {
    if (condition) return;
    std::cerr << what << '\n';
    ++failures;
}

std::string sentence() {
    std::string text(incircle_error(nullptr, 0), '\0');
    incircle_error(text.data(), text.size());
    text.pop_back();
    return text;
}

// Its destructor runs when what the library keeps for the thread is gone.
struct Last {
    ~Last() {
        expect(incircle_mesh_verify(nullptr) == INCIRCLE_ARGUMENT, "a call while the thread ends");
        char text[8] = "xxxxxxx";
        const std::size_t needed = incircle_error(text, sizeof text);
        expect(needed >= 1 && std::string(text).size() < sizeof text, "a sentence while the thread ends");
    }
};
thread_local Last last;

void work(const incircle_mesh *shared, std::uint32_t number) {
    // C++ makes the object when it is first used.
    (void)&last;
    for (int round = 0; round < 200; ++round) {
        incircle_mesh *mesh = nullptr;
        expect(incircle_triangulate(nullptr, 0, 100 + number, nullptr, &mesh) == INCIRCLE_ARGUMENT, "a wrong type");
        expect(sentence().rfind(std::to_string(100 + number) + " is not the number", 0) == 0, "another's sentence");
        std::size_t count = 0;
        expect(incircle_mesh_triangles(shared, nullptr, 0, &count) == INCIRCLE_OK && count == 2, "a shared mesh");
        expect(incircle_mesh_verify(shared) == INCIRCLE_OK, "the proof of a shared mesh");
    }
}

}  // namespace

int main() {
    const double points[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    incircle_mesh *mesh = nullptr;
    expect(incircle_triangulate(points, 4, INCIRCLE_F64, nullptr, &mesh) == INCIRCLE_OK, "a mesh");
    std::vector<std::thread> threads;
    for (std::uint32_t number = 0; number < 8; ++number) threads.emplace_back(work, mesh, number);
    for (std::thread &thread : threads) thread.join();
    incircle_mesh_free(mesh);
    return failures != 0;
}
