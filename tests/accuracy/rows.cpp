// The file of rows, and the progress through the tasks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows.h"

#include "base/error.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace accuracy {

namespace {

using Clock = std::chrono::steady_clock;

/// Fowler, Noll and Vo's hash of 64 bits.
std::uint64_t hashOf(const std::string& text, std::uint64_t hash = 0xcbf29ce484222325) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw eikonal::MissingError("can't read " + path.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string hex(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

/// Rows by key. A last line that was cut short is not JSON and is left out.
std::map<std::string, Json> readRows(const std::string& file) {
    std::map<std::string, Json> rows;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const Json row = Json::parse(line, nullptr, false);
        if (row.is_object() && row.contains("key") && row.contains("values"))
            rows[row["key"].dump()] = row["values"];
    }
    return rows;
}

void append(const std::string& file, const Json& key, const Json& values) {
    std::FILE* out = std::fopen(file.c_str(), "ab");
    if (!out) throw eikonal::InternalError("can't write " + file);
    // A line of its own even after one that was cut short; readRows() skips what is empty.
    const std::string line = "\n" + Json{{"key", key}, {"values", values}}.dump() + "\n";
    std::fwrite(line.data(), 1, line.size(), out);
    std::fclose(out);
}

void tell(size_t at, size_t all, const std::string& label) {
    if (isatty(STDERR_FILENO)) {
        const size_t kWidth = 20, done = kWidth * at / all;
        std::fprintf(stderr, "\r\033[Kaccuracy: [%s%s] %zu/%zu %s", std::string(done, '#').c_str(),
                     std::string(kWidth - done, '.').c_str(), at, all, label.c_str());
        if (at == all) std::fprintf(stderr, "\n");
    } else {
        std::fprintf(stderr, "accuracy: %zu/%zu %s\n", at, all, label.c_str());
    }
    std::fflush(stderr);
}

} // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

std::string libraryVersion() {
    std::uint64_t hash = hashOf(contentOf(EIKONAL_LIBRARY));
    if (const char* shaders = std::getenv("EIKONAL_SHADERS")) {
        std::vector<std::filesystem::path> paths;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shaders))
            if (entry.is_regular_file()) paths.push_back(entry.path());
        std::sort(paths.begin(), paths.end());
        for (const auto& path : paths) hash = hashOf(contentOf(path), hash);
    }
    return hex(hash);
}

std::vector<Json> runTasks(const std::vector<Task>& tasks, const std::string& file) {
    std::map<std::string, Json> known = readRows(file);
    std::vector<Json> rows;
    for (size_t i = 0; i < tasks.size(); ++i) {
        const Task& task = tasks[i];
        const std::string key = task.key.dump();
        if (!known.contains(key)) {
            tell(i + 1, tasks.size(), task.label);
            const auto begin = Clock::now();
            Json values = task.measure();
            values["wall_s"] = std::chrono::duration<double>(Clock::now() - begin).count();
            append(file, task.key, values);
            known[key] = values;
        }
        Json row = task.key;
        row.update(known[key]);
        row["label"] = task.label;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<float> kept(const std::string& folder, const Json& key,
                        const std::function<std::vector<float>()>& make) {
    const std::string path = folder + "/reference-" + hex(hashOf(key.dump())) + ".f32";
    if (std::filesystem::exists(path)) {
        const std::string bytes = contentOf(path);
        std::vector<float> values(bytes.size() / sizeof(float));
        std::copy_n(bytes.data(), values.size() * sizeof(float),
                    reinterpret_cast<char*>(values.data()));
        return values;
    }
    const std::vector<float> values = make();
    const std::string part = path + ".part";
    std::ofstream(part, std::ios::binary)
        .write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(float)));
    std::filesystem::rename(part, path);
    return values;
}

} // namespace accuracy
