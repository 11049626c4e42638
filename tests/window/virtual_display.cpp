// SPDX-License-Identifier: MIT
#include "tests/window/virtual_display.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "tests/window/drop_source.h"

namespace candela::test {

namespace {

// An X error ends the process unless somebody takes it.
int ignore_error(Display*, XErrorEvent*) {
    return 0;
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
                 const std::string& error_file) {
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("no further process can be started");
    if (pid_ != 0) return;
    for (const std::string& setting : environment)
        putenv(strdup(setting.c_str()));
    if (!error_file.empty()) {
        const int file = open(error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(file, STDERR_FILENO);
    }
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(strdup(argument.c_str()));
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(127);
}

Process::~Process() {
    if (status_) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

std::optional<int> Process::wait_for_exit(double timeout_s) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
    while (!status_) {
        int status = 0;
        if (waitpid(pid_, &status, WNOHANG) == pid_) {
            status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        } else if (std::chrono::steady_clock::now() > end) {
            return std::nullopt;
        } else {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    return status_;
}

double Process::cpu_seconds() const {
    // Fields 14 and 15 behind the name, which ends with the last bracket (proc(5)).
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string line;
    std::getline(file, line);
    unsigned long user = 0, system = 0;
    std::sscanf(line.c_str() + line.rfind(')') + 1, " %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &user,
                &system);
    return static_cast<double>(user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

VirtualDisplay::VirtualDisplay(int width, int height) {
    // The server picks a free number and tells it through a pipe.
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe can be made");
    const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
    server_ = std::make_unique<Process>(std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]),
                                                                 "-screen", "0", screen, "-nolisten", "tcp"},
                                        std::vector<std::string>{}, "/dev/null");
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';)
        number += c;
    close(ends[0]);
    if (number.empty()) throw std::runtime_error("Xvfb does not start");
    name_ = ":" + number;
}

ImageRgba8 VirtualDisplay::capture(unsigned long window) const {
    XSetErrorHandler(ignore_error);
    Display* display = XOpenDisplay(name_.c_str());
    if (display == nullptr) throw std::runtime_error("the virtual display is gone");
    XWindowAttributes attributes{};
    XImage* grabbed = nullptr;
    if (XGetWindowAttributes(display, window, &attributes) != 0) {
        grabbed = XGetImage(display, window, 0, 0, static_cast<unsigned>(attributes.width),
                            static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
    }
    if (grabbed == nullptr) {
        XCloseDisplay(display);
        throw std::runtime_error("the window is gone");
    }
    ImageRgba8 out(grabbed->width, grabbed->height);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const unsigned long p = XGetPixel(grabbed, x, y);
            out(x, y) = Rgba8((p >> 16) & 255, (p >> 8) & 255, p & 255, 255);
        }
    }
    XDestroyImage(grabbed);
    XCloseDisplay(display);
    return out;
}

std::string VirtualDisplay::xdotool(const std::string& arguments) const {
    FILE* pipe = popen(("DISPLAY=" + name_ + " xdotool " + arguments + " 2>/dev/null").c_str(), "r");
    std::string text;
    for (int c = 0; (c = fgetc(pipe)) != EOF;)
        text += static_cast<char>(c);
    pclose(pipe);
    return text.substr(0, text.find('\n'));
}

bool VirtualDisplay::drop(unsigned long window, const std::string& path) const {
    return drop_file(name_, window, path);
}

}  // namespace candela::test
