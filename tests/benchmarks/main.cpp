// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "tests/benchmarks/opening_memory.h"

int main(int argc, char** argv) {
    if (argc == 3 && std::string(argv[1]) == "--opening") return candela::bench::print_opening_memory(argv[2]);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
