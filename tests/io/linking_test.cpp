// SPDX-License-Identifier: MIT
// Which library answers to a name that two of them have.
#include <dlfcn.h>

namespace candela {
namespace {

TEST(Linking, TinygltfIsItsOwnLibraryNotDracos) {
    void* function = dlsym(RTLD_DEFAULT, "_ZN8tinygltf8TinyGLTF14SetFsCallbacksENS_11FsCallbacksE");
    ASSERT_NE(function, nullptr);
    Dl_info info{};
    ASSERT_NE(dladdr(function, &info), 0);
    EXPECT_NE(std::string(info.dli_fname).find("libtinygltf"), std::string::npos) << info.dli_fname;
}

}  // namespace
}  // namespace candela
