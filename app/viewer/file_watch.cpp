// SPDX-License-Identifier: MIT
#include "app/viewer/file_watch.h"

#include <sys/stat.h>

namespace candela {

FileWatch::Signature FileWatch::signature_of(const std::string& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0) return {};
    return {true, found.st_ino, found.st_size, found.st_mtim.tv_sec * int64_t{1'000'000'000} + found.st_mtim.tv_nsec};
}

void FileWatch::watch(const std::vector<std::string>& files) {
    std::map<std::string, Signature> known, seen;
    for (const std::string& path : files) {
        const auto before = known_.find(path);
        const Signature now = signature_of(path);
        known[path] = before != known_.end() ? before->second : now;
        seen[path] = before != known_.end() ? seen_[path] : now;
    }
    known_ = std::move(known);
    seen_ = std::move(seen);
}

bool FileWatch::changed(double now_s) {
    if (now_s < next_look_s_) return false;
    next_look_s_ = now_s + look_seconds;
    for (auto& [path, last] : seen_) {
        const Signature now = signature_of(path);
        if (now == last) continue;
        last = now;
        still_since_s_ = now_s;
    }
    if (seen_ == known_ || now_s < still_since_s_ + still_seconds) return false;
    known_ = seen_;
    return true;
}

}  // namespace candela
