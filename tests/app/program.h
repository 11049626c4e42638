// SPDX-License-Identifier: MIT
// The program itself, run with arguments as a shell would, in a folder of the test's own.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace candela::test {

struct Outcome {
    int status = -1;
    std::string text;  // standard output and error together
};

// before: shell commands that prepare its surroundings.
inline Outcome run(const std::string& arguments, const std::string& before = "") {
    Outcome out;
    FILE* pipe = popen((before + std::string(CANDELA_PROGRAM) + " " + arguments + " 2>&1 </dev/null").c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
        out.text.append(buffer.data(), n);
    const int status = pclose(pipe);
    out.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return out;
}

class CommandLine : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("candela cli " + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string file(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
    std::filesystem::path folder_;
};

}  // namespace candela::test
