// SPDX-License-Identifier: MIT
#include "app/viewer/file_dialog.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <sstream>
#include <string_view>

namespace candela {

namespace {

constexpr int poll_ms = 50;
constexpr size_t longest_answer = 1 << 16;

std::string find_program(const char* name, const char* path) {
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        // The current folder is nobody's place for programs.
        if (folder.empty() || folder.front() != '/') continue;
        std::string candidate = folder + "/" + name;
        std::error_code error;
        if (std::filesystem::is_regular_file(candidate, error) && access(candidate.c_str(), X_OK) == 0)
            return candidate;
    }
    return "";
}

// A program without a shell: its standard output, or nothing where it says by its exit status that there is none.
std::optional<std::string> output_of(const std::vector<std::string>& command, const std::atomic<bool>* cancel) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    // What a toolkit grumbles is not the person's business.
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = -1;
    const bool started = posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);

    // Until it closes its output; a window that closes takes the dialog along.
    std::string answer;
    bool stopped = false;
    while (started && answer.size() < longest_answer) {
        pollfd readable{ends[0], POLLIN, 0};
        if (cancel->load()) {
            kill(child, SIGTERM);
            stopped = true;
            break;
        }
        if (poll(&readable, 1, poll_ms) <= 0) continue;
        char buffer[4096];
        const ssize_t count = read(ends[0], buffer, sizeof(buffer));
        if (count <= 0) break;
        answer.append(buffer, static_cast<size_t>(count));
    }
    close(ends[0]);
    int status = -1;
    if (started) waitpid(child, &status, 0);
    if (stopped || !started || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
    if (!answer.empty() && answer.back() == '\n') answer.pop_back();
    if (answer.empty()) return std::nullopt;
    return answer;
}

}  // namespace

std::vector<std::string> dialog_command(DialogPurpose purpose, const std::string& folder, const char* path,
                                        const char* desktop) {
    const bool scene = purpose == DialogPurpose::scene;
    const std::string title = scene ? "Open a scene or an environment" : "Open a reference picture";
    const std::string patterns = scene ? "*.gltf *.glb *.hdr *.exr" : "*.exr *.hdr *.png";
    const std::string kinds = scene ? "scenes and environments" : "pictures";
    // A folder ends in a slash: zenity would take its name for a file's.
    const std::string where = folder.empty() ? "./" : folder + "/";
    const std::string zenity = find_program("zenity", path), kdialog = find_program("kdialog", path);
    const bool kde = desktop != nullptr && std::string_view(desktop).find("KDE") != std::string_view::npos;
    if (!kdialog.empty() && (kde || zenity.empty()))
        return {kdialog, "--title", title, "--getopenfilename", where, kinds + " (" + patterns + ")|all files (*)"};
    if (zenity.empty()) return {};
    return {zenity,
            "--file-selection",
            "--title=" + title,
            "--filename=" + where,
            "--file-filter=" + kinds + " | " + patterns,
            "--file-filter=all files | *"};
}

bool FileDialog::open(DialogPurpose purpose, const std::string& folder) {
    if (task_.busy()) return true;
    std::vector<std::string> command =
        dialog_command(purpose, folder, std::getenv("PATH"), std::getenv("XDG_CURRENT_DESKTOP"));
    if (command.empty()) return false;
    purpose_ = purpose;
    task_.start([words = std::move(command)](const std::atomic<bool>* cancel) { return output_of(words, cancel); });
    return true;
}

}  // namespace candela
