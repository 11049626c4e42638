// SPDX-License-Identifier: MIT
// Tells when files have become others than they were, by what the file system says of them. Files that are still being
// written are waited for.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace candela {

class FileWatch {
  public:
    // From now on these, as they are. Those that were watched already keep what was known of them, so that a change
    // that nobody was told of yet is not lost.
    void watch(const std::vector<std::string>& files);
    bool watches() const { return !known_.empty(); }

    // Looks at them, at most every look_seconds. True once for each change, when what changed has been the same for
    // still_seconds.
    bool changed(double now_s);

    static constexpr double look_seconds = 0.2, still_seconds = 0.3;

  private:
    // What tells one content from another without reading it.
    struct Signature {
        bool exists = false;
        uint64_t inode = 0;
        int64_t size = 0, modified_ns = 0;

        bool operator==(const Signature&) const = default;
    };
    static Signature signature_of(const std::string& path);

    std::map<std::string, Signature> known_;  // as they were when a change was last told
    std::map<std::string, Signature> seen_;   // as they were when last looked at
    double still_since_s_ = 0, next_look_s_ = 0;
};

}  // namespace candela
