// SPDX-License-Identifier: MIT
// The program itself, run with arguments as a shell would, in a folder of the test's own.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace candela::test {

struct Outcome {
    int status = -1;
    std::string text;  // standard output and error together
};

// before: shell commands that prepare its surroundings. configuration: where it might find settings; nobody's own.
inline Outcome run(const std::string& arguments, const std::string& before = "",
                   const std::string& configuration = "/dev/null") {
    Outcome out;
    const std::string program = "env XDG_CONFIG_HOME=" + configuration + " " + CANDELA_PROGRAM;
    FILE* pipe = popen((before + program + " " + arguments + " 2>&1 </dev/null").c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
        out.text.append(buffer.data(), n);
    const int status = pclose(pipe);
    out.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return out;
}

class CommandLine : public ::testing::Test {
  protected:
    std::string file(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
    const TemporaryFolder own_folder_{"candela cli"};
    const std::filesystem::path folder_ = own_folder_.path();
};

}  // namespace candela::test
