#pragma once
// The index.csv of a hostile set: one map (column to text) a row; fields may be quoted.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace daylit::test {

inline std::vector<std::string> split_row(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else if (c != '\r')
            fields.back() += c;
    }
    return fields;
}

inline std::vector<std::map<std::string, std::string>> read_index(const std::filesystem::path& path) {
    std::ifstream stream(path);
    std::string line;
    std::getline(stream, line);
    const std::vector<std::string> columns = split_row(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(stream, line)) {
        const std::vector<std::string> fields = split_row(line);
        if (fields.size() != columns.size()) {
            ADD_FAILURE() << path << " has a row of " << fields.size() << " fields: " << line;
            continue;
        }
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = fields[i];
    }
    return rows;
}

}  // namespace daylit::test
