// Damages VDB files at random and reads what results: vdb_mutations FOLDER COUNT. None may be fatal
// (to be built with the address sanitizer), none take a second.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/mutate.h"
#include "fuzz/read_vdb.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

int main(int argc, char** argv) {
    if (argc != 3) return 64;
    std::vector<std::string> seeds;
    for (const auto& file : std::filesystem::directory_iterator(argv[1])) {
        std::ifstream in(file.path(), std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    const long count = std::stol(argv[2]);
    long refused = 0, slow = 0;
    double slowest = 0;
    const eikonal::MemoryFile file;
    for (long i = 0; i < count && !seeds.empty(); ++i) {
        std::string bytes = seeds[static_cast<size_t>(i) % seeds.size()];
        eikonal::mutate(bytes, static_cast<std::uint32_t>(i));
        file.set(bytes.data(), bytes.size());
        const auto begin = std::chrono::steady_clock::now();
        refused += eikonal::readVdb(file.path()) == eikonal::VdbFate::refused;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        if (took.count() > slowest) {
            slowest = took.count();
            std::printf("mutation %ld: %.3f s\n", i, slowest);
        }
        slow += took.count() > 1;
    }
    std::printf(
        "%ld files of %zu seeds: %ld refused, %ld read, %ld slower than 1 s, slowest %.3f s\n",
        count, seeds.size(), refused, count - refused, slow, slowest);
    return slow > 0;
}
